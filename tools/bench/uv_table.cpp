// uv_table MESH: how good a mesh's texture coordinates are, as JSON.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <nlohmann/json.hpp>

#include "formats/base/error.h"
#include "formats/files/input_format.h"
#include "formats/surface/uv_statistics.h"
#include "tools/bench/bench_program.h"

namespace lozenge::bench {
namespace {

/// The first mesh that the asset places, all of its primitives.
UvSurface read_uvs(const std::string& path, int set) {
  const InputAsset asset = open_input(path);
  UvSurface surface;
  const int mesh = asset.instances.front().mesh;
  for (int p = 0; p < static_cast<int>(asset.meshes[mesh].primitives.size()); ++p) {
    const Primitive primitive = asset.read(mesh, p);
    const AttributeStream* uvs = find_stream(primitive.attributes, kTextureCoordinates, set);
    if (uvs == nullptr) throw Error(ExitCode::kUnusableInput, path + ": has no such texture coordinates");
    const auto first = static_cast<std::uint32_t>(surface.positions.size());
    for (std::size_t v = 0; v < primitive.vertices(); ++v) {
      const float* p3 = &primitive.positions[3 * v];
      surface.positions.emplace_back(p3[0], p3[1], p3[2]);
      surface.uvs.push_back(vector_at<Vec2f>(*uvs, v));
    }
    for (const auto& [a, b, c] : primitive.triangles) surface.triangles.push_back({first + a, first + b, first + c});
  }
  return surface;
}

nlohmann::ordered_json json_of(const UvSurface& surface, const UvStatistics& s) {
  return {{"triangles", surface.triangles.size()},
          {"vertices", surface.positions.size()},
          {"charts", s.charts},
          {"seam_length", s.seam_length},
          {"seam_by_root_of_area", s.area > 0 ? s.seam_length / std::sqrt(s.area) : 0},
          {"l2_stretch", s.l2_stretch},
          {"atlas_share", s.atlas_share},
          {"folded", s.folded},
          {"outside", s.outside},
          {"overlapping_texels", s.overlapping_texels},
          {"least_gap", s.least_gap}};
}

}  // namespace
}  // namespace lozenge::bench

int main(int argc, char** argv) {
  namespace bench = lozenge::bench;
  CLI::App app("Prints how good a mesh's texture coordinates are, as JSON: seams, stretch, overlaps", "uv_table");
  std::string input;
  int size = 2048;
  int set = 0;
  app.add_option("mesh", input, "A .glb or .gltf; its first mesh counts")->required()->type_name("");
  app.add_option("--size", size, "Texels of the atlas's side [2048]");
  app.add_option("--set", set, "Which set of texture coordinates [0]");
  return bench::run_bench_program(app, argc, argv, [&] {
    const lozenge::UvSurface surface = bench::read_uvs(input, set);
    fmt::print("{}\n", bench::json_of(surface, lozenge::uv_statistics(surface, size)).dump());
  });
}
