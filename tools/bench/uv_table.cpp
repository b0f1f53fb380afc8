// uv_table MESH: how good a mesh's texture coordinates are, as JSON.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <nlohmann/json.hpp>

#include "formats/files/uv_surface_file.h"
#include "tools/bench/bench_program.h"

namespace lozenge::bench {
namespace {

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
    const lozenge::UvSurface surface = lozenge::read_uv_surface(input, set);
    fmt::print("{}\n", bench::json_of(surface, lozenge::uv_statistics(surface, size)).dump());
  });
}
