#include "stages/import/surface_materials.h"

#include <tiny_gltf.h>

#include "formats/files/gltf_source_mesh.h"

namespace lozenge {

SurfaceMaterials::SurfaceMaterials(const GltfFile& file) : of_file_(file.model->materials.size()) {
  for (const tinygltf::Material& material : file.model->materials) names_.push_back(material.name);
}

std::int32_t SurfaceMaterials::of_repeated(std::int32_t mesh, std::int32_t material) {
  const auto [place, is_new] = added_.try_emplace({mesh, material}, static_cast<std::int32_t>(names_.size()));
  if (is_new) names_.push_back(material < 0 ? "default" : names_[material]);
  return place->second;
}

void SurfaceMaterials::describe(const GltfFile& file, std::vector<RepeatedMesh> repeated, SourceMesh& mesh) const {
  const std::size_t count = mesh.material_names.size();
  mesh.cap_of = find_stored_caps(file);
  if (mesh.cap_of.size() != count) mesh.cap_of.clear();
  mesh.double_sided = double_sided_materials(file, count);
  if (repeated.empty()) {
    mesh.repeats = find_stored_repeats(file);
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
