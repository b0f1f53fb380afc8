#include "formats/files/uv_surface_file.h"

#include "formats/base/error.h"
#include "formats/files/input_format.h"

namespace lozenge {

UvSurface read_uv_surface(const std::filesystem::path& path, int set) {
  const InputAsset asset = open_input(path);
  if (asset.instances.empty()) throw Error(ExitCode::kUnusableInput, asset.file + ": places no mesh");
  UvSurface surface;
  const int mesh = asset.instances.front().mesh;
  for (int p = 0; p < static_cast<int>(asset.meshes[mesh].primitives.size()); ++p) {
    const Primitive primitive = asset.read(mesh, p);
    const AttributeStream* uvs = find_stream(primitive.attributes, kTextureCoordinates, set);
    if (uvs == nullptr) {
      throw Error(ExitCode::kUnusableInput,
                  asset.file + ": has no " + attribute_name(kTextureCoordinates, set) + " everywhere");
    }
    const auto first = static_cast<std::uint32_t>(surface.positions.size());
    for (std::size_t v = 0; v < primitive.vertices(); ++v) {
      const float* position = &primitive.positions[3 * v];
      surface.positions.emplace_back(position[0], position[1], position[2]);
      surface.uvs.push_back(vector_at<Vec2f>(*uvs, v));
    }
    for (const auto& [a, b, c] : primitive.triangles) surface.triangles.push_back({first + a, first + b, first + c});
  }
  return surface;
}

}  // namespace lozenge
