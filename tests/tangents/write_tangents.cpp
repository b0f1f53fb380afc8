// write_tangents ASSET.glb OUT.json: at each corner of an asset's triangles that have a normal texture: position,
// normal, texture coordinates in that texture, and the tangent that baking reads the texture by (xyz, and the sign of
// the bitangent).

#include <exception>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>

#include "stages/bake/source_tangents.h"
#include "stages/import/import.h"

namespace lozenge {
namespace {

std::optional<TextureUse> normal_texture(const Material& material) {
  const TextureUse& use = material.texture(TextureRole::kNormal);
  return use.exists() ? std::optional(use) : std::nullopt;
}

template <typename Vector>
void append(nlohmann::json& list, const Vector& v) {
  for (unsigned c = 0; c < Vector::dimensions(); ++c) list.push_back(v[static_cast<int>(c)]);
}

nlohmann::json corners_of(const SourceMesh& mesh) {
  const ShadingNormals normals(mesh);
  const SourceTangents tangents(mesh, normals, normal_texture);
  nlohmann::json positions, shading, texcoords, found;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto use = normal_texture(mesh.material_looks.at(mesh.materials[t]));
    if (!use) continue;
    const AttributeStream* uv = find_stream(mesh.corner_attributes, kTextureCoordinates, use->set);
    for (int c = 0; c < 3; ++c) {
      Vec3d weights(0, 0, 0);
      weights[c] = 1;
      const auto id = static_cast<TriangleId>(t);
      const Vec3d normal(normals.at(id, weights));
      const Vec3d tangent = tangents.to_object(id, weights, normal, {1, 0, 0});
      const Vec3d bitangent = tangents.to_object(id, weights, normal, {0, 1, 0});
      append(positions, mesh.positions[mesh.triangles[t][c]]);
      append(shading, normal);
      append(texcoords, place_in_texture(*use, Vec2d(vector_at<Vec2f>(*uv, 3 * t + static_cast<std::size_t>(c)))));
      append(found, tangent);
      found.push_back(normal.cross(tangent).dot(bitangent) < 0 ? -1 : 1);
    }
  }
  return {{"positions", positions}, {"normals", shading}, {"texcoords", texcoords}, {"tangents", found}};
}

}  // namespace
}  // namespace lozenge

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "usage: write_tangents ASSET.glb OUT.json\n";
    return 2;
  }
  try {
    std::ofstream(argv[2]) << lozenge::corners_of(lozenge::import_asset(argv[1]));
  } catch (const std::exception& error) {
    std::cerr << "write_tangents: " << error.what() << '\n';
    return 1;
  }
}
