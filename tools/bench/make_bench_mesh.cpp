// make_bench_mesh: a mesh made larger, or uneven, to measure with.
#include <CLI/CLI.hpp>
#include <optional>

#include "formats/base/error.h"
#include "tools/bench/bench_mesh.h"
#include "tools/bench/bench_program.h"
#include "tools/bench/mesh_file.h"

namespace lozenge::bench {
namespace {

struct Arguments {
  std::string input;
  std::string output;
  std::int32_t sphere = 0;
  std::int32_t torus = 0;
  std::optional<std::uint64_t> uneven;
  UnevenOptions uneven_options;
  int times = 0;
  double noise_percent = 0;
  std::uint64_t noise_seed = 1;
};

Surface begin(const Arguments& arguments) {
  if (arguments.sphere > 0) return sphere_mesh(arguments.sphere);
  if (arguments.torus > 0) return torus_mesh(arguments.torus);
  if (arguments.input.empty()) throw Error(ExitCode::kUsage, "give a mesh, --sphere or --torus");
  return welded(read_mesh(arguments.input));
}

void make(const Arguments& arguments) {
  Surface mesh = begin(arguments);
  if (arguments.uneven) mesh = uneven(mesh, *arguments.uneven, arguments.uneven_options);
  mesh = subdivided(mesh, arguments.times, arguments.noise_percent / 100, arguments.noise_seed);
  write_mesh(arguments.output, mesh);
}

void add_options(CLI::App& app, Arguments& arguments) {
  constexpr std::int32_t kMostTriangles = 100'000'000;
  CLI::Option* input = app.add_option("mesh", arguments.input, "Any mesh that mesh_to_glb reads")->type_name("");
  app.add_option("-o,--output", arguments.output, "A .glb, or an .off")->required()->type_name("PATH");
  CLI::Option* sphere = app.add_option("--sphere", arguments.sphere, "Instead of a mesh: a sphere of about N triangles")
                            ->check(CLI::Range(20, kMostTriangles).description(""))
                            ->type_name("N")
                            ->excludes(input);
  app.add_option("--torus", arguments.torus, "Instead of a mesh: a ring of about N triangles")
      ->check(CLI::Range(20, kMostTriangles).description(""))
      ->type_name("N")
      ->excludes(input)
      ->excludes(sphere);
  app.add_option("--most-turn", arguments.uneven_options.most_turn,
                 "With --uneven: how far a triangle's normal may turn, degrees")
      ->check(CLI::Range(1.0, 85.0))
      ->capture_default_str();
  app.add_option("--uneven", arguments.uneven, "Make the triangles thin and of very different sizes, as chance has it")
      ->type_name("SEED");
  app.add_option("--subdivide", arguments.times, "Then cut every triangle in four, so often")
      ->check(CLI::Range(0, 10).description(""))
      ->type_name("TIMES");
  app.add_option("--noise", arguments.noise_percent, "Move new vertices by up to so many percent of the edges' length")
      ->check(CLI::Range(0.0, 100.0).description(""))
      ->type_name("PERCENT");
  app.add_option("--noise-seed", arguments.noise_seed, "Chance for --noise")->type_name("SEED")->capture_default_str();
}

}  // namespace
}  // namespace lozenge::bench

int main(int argc, char** argv) {
  namespace bench = lozenge::bench;
  CLI::App app("Makes a mesh to measure with, the same at every run", "make_bench_mesh");
  bench::Arguments arguments;
  bench::add_options(app, arguments);
  return bench::run_bench_program(app, argc, argv, [&] { bench::make(arguments); });
}
