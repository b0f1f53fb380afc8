// Surfaces with a boundary, from their map to the asset, one command after the other.
#include <nlohmann/json.hpp>

#include "formats/domain/open_fixtures.h"
#include "formats/files/parameterization_file.h"
#include "tests/end_to_end/run_program.h"

namespace lozenge::end_to_end {
namespace {

using nlohmann::json;

class OpenSurfaces : public InOwnFolder<> {
 protected:
  json result_of(std::vector<std::string> arguments) {
    arguments.push_back("--json");
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.code, 0) << arguments[0] << ": " << outcome.err << outcome.out;
    return outcome.code == 0 ? json::parse(outcome.out) : json();
  }

  void passes_check(const std::string& file) {
    const Outcome outcome = run({"check", file});
    EXPECT_EQ(outcome.code, 0) << outcome.out << outcome.err;
  }
};

TEST_F(OpenSurfaces, GoFromMapToAssetAndEveryFilePassesItsCheck) {
  // As large as real domains: the last has 200 triangles and 40,000 source triangles.
  for (const fixtures::OpenSurface& open :
       {fixtures::triangle(9), fixtures::hemisphere(24), fixtures::fan(4, 16), fixtures::open_and_closed(12),
        fixtures::annulus(6, 97, 30, 0.375), fixtures::annulus(100, 1000, 20, 0.37)}) {
    const std::string map = path("map.glb");
    write_parameterization(map, open.mesh, open.map);
    passes_check(map);
    result_of({"sample", map, "-o", path("patches.exr"), "--samples", "17"});
    passes_check(path("patches.exr"));
    result_of({"pack", path("patches.exr"), "-o", path("open.gim.exr")});
    passes_check(path("open.gim.exr"));
    const json baked = result_of({"bake", map, path("open.gim.exr"), "-o", path("open"), "--map-size", "512"});
    EXPECT_GT(baked["bake"]["unused_texels"], 0) << open.name;
    EXPECT_LE(baked["bake"]["fallback_texels"].get<double>(), 0.02 * baked["bake"]["texels"].get<double>())
        << open.name;
    passes_check(path("open.normal.png"));
    passes_check(path("open.occlusion.png"));
    const json made_of = result_of({"export", path("open.gim.exr"), "--map", path("open.normal.png"),
                                    path("open.occlusion.png"), "-o", path("open.glb"), "--lods", "3"});
    passes_check(path("open.glb"));
    for (const std::string made : {"open.glb", "open.gim.exr"}) {
      const json distance = result_of({"compare", map, path(made), "--points", "20000"});
      EXPECT_EQ(distance["boundary_loops"]["a"], open.loops) << open.name;
      EXPECT_EQ(distance["boundary_loops"]["b"], open.loops) << open.name;
      // Corners of the source's boundary between two samples are cut off.
      EXPECT_LT(distance["boundary_max_distance_percent"], 0.2) << open.name;
      // Levels of an asset that would be heavier than its source are left out.
      const int coarsest = made == "open.glb" ? made_of["asset"]["levels"].get<int>() - 1 : 3;
      const json coarser =
          result_of({"compare", map, path(made), "--level", std::to_string(coarsest), "--points", "20000"});
      EXPECT_EQ(coarser["boundary_loops"]["b"], open.loops) << open.name;
    }
    result_of(
        {"render", path("open.glb"), "--style", "baked", "-o", path("open.png"), "--width", "64", "--height", "64"});
    result_of({"render", path("open.gim.exr"), "--style", "patches", "-o", path("open.png"), "--width", "64",
               "--height", "64"});
    result_of({"info", path("open.gim.exr")});
  }
}

TEST_F(OpenSurfaces, GiveTheSameBytesOnAnyNumberOfThreads) {
  const fixtures::OpenSurface open = fixtures::annulus(6, 97, 30, 0.375);
  write_parameterization(path("map.glb"), open.mesh, open.map);
  std::vector<std::string> files[2];
  for (const std::string threads : {"1", "4"}) {
    const std::string name = path("open" + threads);
    result_of({"sample", path("map.glb"), "-o", name + ".patches.exr", "--threads", threads});
    result_of({"pack", name + ".patches.exr", "-o", path("open.gim.exr"), "--threads", threads});
    result_of({"bake", path("map.glb"), path("open.gim.exr"), "-o", name, "--map-size", "256", "--threads", threads});
    result_of(
        {"export", path("open.gim.exr"), "--map", name + ".normal.png", "-o", path("open.glb"), "--threads", threads});
    for (const std::string& file : {name + ".patches.exr", name + ".normal.png", name + ".occlusion.png",
                                    path("open.gim.exr"), path("open.glb")}) {
      files[threads == "4"].push_back(read_text(file));
    }
  }
  EXPECT_EQ(files[0], files[1]);
}

}  // namespace
}  // namespace lozenge::end_to_end
