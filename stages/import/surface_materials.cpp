#include "stages/import/surface_materials.h"

namespace lozenge {

SurfaceMaterials::SurfaceMaterials(const InputAsset& asset)
    : names_(asset.material_names), of_file_(asset.material_names.size()) {}

std::int32_t SurfaceMaterials::of_body(std::int32_t body, std::int32_t material) {
  const auto [place, is_new] = added_.try_emplace({body, material}, static_cast<std::int32_t>(names_.size()));
  if (is_new) names_.push_back(material < 0 ? "default" : names_[material]);
  return place->second;
}

void SurfaceMaterials::describe(const InputAsset& asset, std::vector<Body> bodies, SourceMesh& mesh) const {
  const std::size_t count = mesh.material_names.size();
  mesh.cap_of = asset.cap_of;
  if (mesh.cap_of.size() != count) mesh.cap_of.clear();
  mesh.material_looks = asset.material_looks;
  mesh.images = asset.images;
  if (!mesh.material_looks.empty()) mesh.material_looks.resize(count);
  mesh.double_sided = asset.double_sided;
  if (!mesh.double_sided.empty()) mesh.double_sided.resize(count, false);
  if (bodies.empty()) {
    mesh.bodies = asset.bodies;
    if (mesh.bodies.owner.size() != count) mesh.bodies = {};
    if (!mesh.bodies.empty()) mesh.rig = asset.rig;
    return;
  }
  // What moved had no triangles.
  if (added_.empty()) return;
  mesh.rig = asset.rig;
  mesh.bodies = {std::move(bodies), std::vector<std::int32_t>(count, -1)};
  for (const auto& [of, material] : added_) {
    mesh.bodies.owner[material] = of.first;
    if (!mesh.material_looks.empty() && of.second >= 0) mesh.material_looks[material] = mesh.material_looks[of.second];
    if (!mesh.double_sided.empty() && of.second >= 0) mesh.double_sided[material] = mesh.double_sided[of.second];
  }
}

}  // namespace lozenge
