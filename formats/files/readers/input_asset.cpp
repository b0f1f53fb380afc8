#include "formats/files/readers/input_asset.h"

#include <filesystem>
#include <memory>

namespace lozenge {

namespace {

/// Of what a primitive is made of, in bytes.
std::uint64_t memory_of(const Primitive& primitive) {
  std::uint64_t floats = primitive.positions.size();
  for (const AttributeStream& stream : primitive.attributes) floats += stream.values.size();
  return sizeof(float) * floats + sizeof(primitive.triangles[0]) * primitive.triangles.size();
}

}  // namespace

std::string count_of(std::int64_t number, const std::string& noun) {
  return std::to_string(number) + " " + noun + (number == 1 ? "" : "s");
}

std::string place_of(const InputAsset& asset, const InputInstance& instance, int primitive) {
  if (instance.node < 0) return asset.file;
  return asset.file + ": node " + std::to_string(instance.node) + ", mesh " + std::to_string(instance.mesh) +
         " primitive " + std::to_string(asset.meshes[instance.mesh].primitives[primitive].number);
}

InputAsset asset_of_one_mesh(const std::string& file, std::vector<Primitive> primitives,
                             std::vector<std::string> material_names) {
  InputAsset asset;
  asset.file = file;
  asset.scene_name = std::filesystem::path(file).stem().string();
  asset.origin = file;
  asset.material_names = std::move(material_names);
  InputMesh& mesh = asset.meshes.emplace_back();
  mesh.name = asset.scene_name;
  for (const Primitive& primitive : primitives) {
    const auto number = static_cast<int>(mesh.primitives.size());
    mesh.primitives.push_back({number, primitive.vertices(), primitive.triangles.size(), primitive.material});
    asset.memory += memory_of(primitive);
  }
  asset.instances.emplace_back().mesh = 0;
  // Who reads them moves them out: they are large.
  const auto kept = std::make_shared<std::vector<Primitive>>(std::move(primitives));
  asset.extent = [kept](int, int primitive, bool) {
    const std::vector<float>& from = (*kept)[primitive].positions;
    std::vector<Vec3f> positions;
    for (std::size_t i = 0; i + 2 < from.size(); i += 3) positions.emplace_back(from[i], from[i + 1], from[i + 2]);
    return bounds_of(positions);
  };
  asset.read = [kept](int, int primitive) { return std::move((*kept)[primitive]); };
  return asset;
}

}  // namespace lozenge
