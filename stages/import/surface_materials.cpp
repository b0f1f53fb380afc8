#include "stages/import/surface_materials.h"

namespace lozenge {

SurfaceMaterials::SurfaceMaterials(const InputAsset& asset)
    : names_(asset.material_names), of_file_(asset.material_names.size()) {}

std::int32_t SurfaceMaterials::of_repeated(std::int32_t mesh, std::int32_t material) {
  const auto [place, is_new] = added_.try_emplace({mesh, material}, static_cast<std::int32_t>(names_.size()));
  if (is_new) names_.push_back(material < 0 ? "default" : names_[material]);
  return place->second;
}

void SurfaceMaterials::describe(const InputAsset& asset, std::vector<RepeatedMesh> repeated, SourceMesh& mesh) const {
  const std::size_t count = mesh.material_names.size();
  mesh.cap_of = asset.cap_of;
  if (mesh.cap_of.size() != count) mesh.cap_of.clear();
  mesh.double_sided = asset.double_sided;
  if (!mesh.double_sided.empty()) mesh.double_sided.resize(count, false);
  if (repeated.empty()) {
    mesh.repeats = asset.repeats;
    if (mesh.repeats.owner.size() != count) mesh.repeats = {};
    return;
  }
  mesh.repeats = {std::move(repeated), std::vector<std::int32_t>(count, -1)};
  for (const auto& [of, material] : added_) {
    mesh.repeats.owner[material] = of.first;
    if (!mesh.double_sided.empty() && of.second >= 0) mesh.double_sided[material] = mesh.double_sided[of.second];
  }
}

}  // namespace lozenge
