// mesh_table MESH: how even a mesh is, as JSON: the columns of the paper's Table 1.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>
#include <numbers>

#include "formats/surface/mesh_statistics.h"
#include "tools/bench/bench_program.h"
#include "tools/bench/mesh_file.h"

namespace lozenge::bench {
namespace {

constexpr double kDegrees = 180 / std::numbers::pi;

nlohmann::ordered_json json_of(const Spread& s) {
  return {{"sigma_percent", s.sigma}, {"min_percent", s.min}, {"max_percent", s.max}};
}

nlohmann::ordered_json json_of(const MeshStatistics& s) {
  return {{"vertices", s.vertices},
          {"triangles", s.triangles},
          {"closed_manifold", is_closed_manifold(s)},
          {"area", json_of(s.area)},
          {"min_angle_degrees", s.min_angle * kDegrees},
          {"mean_min_angle_degrees", s.mean_min_angle * kDegrees},
          {"edge", json_of(s.edge)},
          {"irregular_percent", s.irregular_percent}};
}

}  // namespace
}  // namespace lozenge::bench

int main(int argc, char** argv) {
  namespace bench = lozenge::bench;
  CLI::App app("Prints how even a mesh is, as JSON: areas, angles, edges and valences", "mesh_table");
  std::string input;
  app.add_option("mesh", input, "An .off, .obj, .ply, .stl, .glb or .gltf")->required()->type_name("");
  return bench::run_bench_program(app, argc, argv, [&] {
    const lozenge::Surface mesh = bench::welded(bench::read_mesh(input));
    fmt::print("{}\n", bench::json_of(lozenge::mesh_statistics(mesh.view())).dump());
  });
}
