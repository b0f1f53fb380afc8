// The commands beside `build`: plain remeshes, comparisons, pictures, and round trips from glTF to glTF.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "test_assets/assets.h"
#include "tests/end_to_end/run_program.h"

namespace lozenge::end_to_end {
namespace {

using nlohmann::json;

json result_of(std::vector<std::string> arguments) {
  arguments.push_back("--json");
  const Outcome outcome = run(arguments);
  EXPECT_EQ(outcome.code, 0) << arguments[0] << ": " << outcome.err;
  return outcome.code == 0 ? json::parse(outcome.out) : json();
}

class Stages : public InOwnFolder<> {
 protected:
  /// The parameterized file of a test asset.
  std::string parameterized(const std::string& asset, const std::string& faces) {
    result_of({"import", test_asset(asset), "-o", path("mesh.glb")});
    result_of({"parameterize", path("mesh.glb"), "-o", path("map.glb"), "--domain-faces", faces});
    return path("map.glb");
  }
};

TEST_F(Stages, ARemeshOfEachPartitionIsClosedAndHasTheSourcesTopology) {
  const std::string map = parameterized("genus3.glb", "40..100");
  for (const std::string partition : {"faces", "half-diamonds", "half-stars"}) {
    const std::string file = path(partition + ".glb");
    result_of({"sample", map, "-o", file, "--partition", partition, "--rate", "8"});
    const json source = result_of({"import", file, "-o", path("again.glb"), "--strict"})["source"];
    EXPECT_EQ(source["boundary_edges"], 0) << partition;
    EXPECT_EQ(source["euler"], -4) << partition;
    EXPECT_EQ(source["components"], 1) << partition;
    EXPECT_LT(result_of({"compare", test_asset("genus3.glb"), file})["mean_percent"], 0.3) << partition;
  }
}

TEST_F(Stages, APlainRemeshHasTheTrianglesThatItsRateSays) {
  const std::string map = parameterized("sphere.glb", "40..50");
  for (const int rate : {1, 5, 16}) {
    const json report =
        result_of({"sample", map, "-o", path("faces.glb"), "--partition", "faces", "--rate", std::to_string(rate)});
    EXPECT_EQ(report["asset"]["triangles"], report["domain"]["triangles"].get<int>() * rate * rate);
  }
}

TEST_F(Stages, ParameterizeReportsTheQualityOfItsMap) {
  const std::string mesh = path("mesh.glb");
  result_of({"import", test_asset("torus.glb"), "-o", mesh});
  const json report =
      result_of({"parameterize", mesh, "-o", path("map.glb"), "--domain-faces", "40..60", "--report", path("r.json")});
  EXPECT_EQ(report, json::parse(read_text(path("r.json"))));
  EXPECT_EQ(report["distortion"]["folded_triangles"], 0);
  EXPECT_GE(report["domain"]["triangles"], 40);
  EXPECT_LE(report["domain"]["triangles"], 60);
  EXPECT_GT(report["distortion"]["l2_stretch"], 1);
}

TEST_F(Stages, AnOutputThatCannotBeWrittenIsNamedBeforeTheInputIsRead) {
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"import"}, {"parameterize"}, {"sample"}, {"pack"}, {"export"}, {"render"}}) {
    const Outcome refused = run({command[0], path("no_such_file"), "-o", path("nowhere/out.glb")});
    EXPECT_EQ(refused.code, 2) << command[0] << ": " << refused.err;
    EXPECT_NE(refused.err.find("nowhere"), std::string::npos) << command[0] << ": " << refused.err;
  }
  EXPECT_TRUE(content().empty());
}

TEST_F(Stages, TheTraceOfAParameterizationCanBeDrawn) {
  result_of({"import", test_asset("sphere.glb"), "-o", path("mesh.glb")});
  const json report = result_of({"parameterize", path("mesh.glb"), "-o", path("map.glb"), "--domain-faces", "40..50",
                                 "--trace", path("trace.json")});
  const json trace = json::parse(read_text(path("trace.json")))["trace"];
  EXPECT_GE(trace.size(), 2u);
  EXPECT_TRUE(std::any_of(trace.begin(), trace.end(),
                          [&](const json& row) { return row["domain_faces"] == report["domain"]["triangles"]; }));
  result_of({"render", path("trace.json"), "--style", "trace", "-o", path("trace.png")});
  EXPECT_TRUE(read_text(path("trace.png")).starts_with("\x89PNG"));
}

TEST_F(Stages, EveryStyleOfPictureIsDrawn) {
  const std::vector<std::string> small = {"--width", "96", "--height", "80"};
  ASSERT_EQ(
      run({"build", test_asset("sphere.glb"), "-o", path("out"), "--domain-faces", "40", "--map-size", "256"}).code, 0);
  const std::string map = parameterized("sphere.glb", "40");
  const std::string image = path("out/sphere.gim.exr");
  const std::vector<std::vector<std::string>> pictures = {
      {test_asset("sphere.glb")},
      {test_asset("sphere.glb"), "--style", "wires"},
      {test_asset("seams.gltf")},
      {map},
      {map, "--style", "patches"},
      {map, "--style", "distortion"},
      {image},
      {image, "--style", "wires", "--level", "1"},
      {image, "--style", "patches", "--from", "0", "0", "1"},
      {image, "--style", "baked", "--map", path("out/sphere.normal.png"), path("out/sphere.occlusion.png")},
      {path("out/sphere.glb"), "--style", "baked"},
      {path("out/sphere.glb"), "--level", "1"}};
  for (const std::vector<std::string>& picture : pictures) {
    std::vector<std::string> command = {"render", "-o", path("picture.png")};
    command.insert(command.end(), picture.begin(), picture.end());
    command.insert(command.end(), small.begin(), small.end());
    const json result = result_of(command);
    EXPECT_EQ(result["width"], 96);
    EXPECT_EQ(result["height"], 80);
    EXPECT_EQ(result_of({"info", path("picture.png")})["height"], 80);
    EXPECT_TRUE(read_text(path("picture.png")).starts_with("\x89PNG"));
    std::filesystem::remove(path("picture.png"));
  }
}

TEST_F(Stages, RepeatedMeshesAreShownInAllTheirPlaces) {
  const auto picture_of = [&](const std::string& instances, const std::string& style) {
    result_of({"import", test_asset("rings.glb"), "-o", path("mesh.glb"), "--instances", instances});
    result_of(
        {"render", path("mesh.glb"), "--style", style, "-o", path("picture.png"), "--width", "96", "--height", "80"});
    return read_text(path("picture.png"));
  };
  EXPECT_EQ(picture_of("shared", "wires"), picture_of("separate", "wires"));
  // Normals come from the file in one and from the triangles in the other: nearly the same.
  const double shared = static_cast<double>(picture_of("shared", "shaded").size());
  EXPECT_NEAR(shared / static_cast<double>(picture_of("separate", "shaded").size()), 1, 0.05);
}

TEST_F(Stages, ALevelThatIsNotThereIsNamed) {
  ASSERT_EQ(run({"build", test_asset("sphere.glb"), "-o", path("out"), "--domain-faces", "40", "--samples", "17",
                 "--map-size", "256"})
                .code,
            0);
  const std::string image = path("out/sphere.gim.exr");
  const Outcome refused = run({"compare", test_asset("sphere.glb"), image, "--level", "5"});
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.err.find("0 to 4"), std::string::npos) << refused.err;
}

TEST_F(Stages, MapsThatWereBakedForAnotherLevelAreRefused) {
  const std::string map = parameterized("sphere.glb", "40");
  const std::string image = path("sphere.gim.exr");
  result_of({"sample", map, "-o", path("patches.exr")});
  result_of({"pack", path("patches.exr"), "-o", image});
  result_of({"bake", map, image, "-o", path("sphere"), "--samples", "5", "--map-size", "256"});
  const Outcome refused = run({"export", image, "--map", path("sphere.normal.png"), "-o", path("sphere.glb")});
  EXPECT_EQ(refused.code, 2) << refused.err;
  EXPECT_NE(refused.err.find("sphere.normal.png"), std::string::npos) << refused.err;
  EXPECT_EQ(run({"export", image, "--samples", "5", "--map", path("sphere.normal.png"), "-o", path("sphere.glb")}).code,
            0);
}

}  // namespace
}  // namespace lozenge::end_to_end
