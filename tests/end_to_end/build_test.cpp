// `lozenge build` over every test asset: what it must give, whatever the shape.
#include <nlohmann/json.hpp>

#include <algorithm>
#include <csignal>

#include "formats/files/asset_file.h"
#include "test_assets/assets.h"
#include "tests/end_to_end/run_program.h"

namespace lozenge::test_assets {

/// How a failed test calls what it ran on.
static void PrintTo(const Asset& asset, std::ostream* out) { *out << asset.file; }

}  // namespace lozenge::test_assets

namespace lozenge::end_to_end {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test_assets::Asset;

/// Domains that suit the size of the test assets, and maps that take no time.
const std::vector<std::string> kSmall = {"--domain-faces",   "60..120", "--map-size",       "512",
                                         "--occlusion-size", "128",     "--occlusion-rays", "16"};

/// Percent of the box diagonal that the asset's boundary may be away from the source's. Corners of the source's between
/// two samples are cut off; the cut of the Klein bottle, on 60 domain triangles, loses most, and half as much with
/// twice the samples.
constexpr double kMostAtBoundary = 0.6;

std::vector<std::string> with(std::vector<std::string> arguments, const std::vector<std::string>& more) {
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

/// "bad/open_surface.glb" as "bad_open_surface_glb".
std::string test_name(const ::testing::TestParamInfo<Asset>& info) {
  std::string name(info.param.file);
  std::replace_if(
      name.begin(), name.end(), [](char c) { return c == '.' || c == '/'; }, '_');
  return name;
}

/// The names of all files of a build.
std::vector<std::string> outputs(const std::string& name, std::string_view maps = "normal occlusion ") {
  std::vector<std::string> files{name + ".gim.exr", name + ".gim.json", name + ".glb"};
  for (; !maps.empty(); maps.remove_prefix(maps.find(' ') + 1)) {
    files.push_back(name + "." + std::string(maps.substr(0, maps.find(' '))) + ".png");
  }
  std::sort(files.begin(), files.end());
  return files;
}

class Build : public InOwnFolder<::testing::TestWithParam<Asset>> {
 protected:
  std::string input() const { return test_asset(GetParam().file); }
  std::string name() const { return fs::path(GetParam().file).stem().string(); }

  bool is_open() const { return GetParam().boundary_loops > 0; }

  void expect_topology(const json& facts) const {
    EXPECT_EQ(facts["components"], GetParam().components);
    EXPECT_EQ(facts["euler"], GetParam().euler);
    EXPECT_EQ(facts["boundary_loops"], GetParam().boundary_loops);
  }

  /// The finest level of the asset is such a surface as the source once equal positions are welded, and lies on it.
  void expect_source_again(const std::string& asset) const {
    const Outcome again = run({"import", asset, "-o", path("again.glb"), "--json", "--strict"});
    ASSERT_EQ(again.code, 0) << again.err;
    const json source = json::parse(again.out)["source"];
    expect_topology(source);
    const Outcome compared = run({"compare", input(), asset, "--json"});
    ASSERT_EQ(compared.code, 0) << compared.err;
    const json distances = json::parse(compared.out);
    EXPECT_LE(distances["mean_percent"], 0.1);
    if (is_open()) {
      EXPECT_LE(distances["boundary_max_distance_percent"], kMostAtBoundary);
    }
  }
};

TEST_P(Build, GivesAnAssetThatKeepsEveryGuaranteeAndIsTheSourceAgain) {
  const Outcome built = run(
      with({"build", input(), "-o", path("out"), "--report", path("report.json"), "--json", "--no-preview"}, kSmall));
  ASSERT_EQ(built.code, 0) << built.err;

  const json report = json::parse(built.out);
  EXPECT_EQ(report, json::parse(read_text(path("report.json"))));
  EXPECT_EQ(report["source"]["triangles"], GetParam().triangles);
  expect_topology(report["source"]);
  // A small part keeps its own triangles.
  // Several parts share what is asked for, and each gets as many as keeps all equally dense.
  const int least = report["source"]["components"] == 1 ? 60 : 54;
  EXPECT_GE(report["domain"]["triangles"], std::min(least, GetParam().triangles));
  EXPECT_LE(report["domain"]["triangles"], 120);
  EXPECT_EQ(report["distortion"]["folded_triangles"], 0);
  EXPECT_LE(report["distortion"]["area_sum_error"], 1e-9);
  // A patch for each edge of the domain; half of one on its boundary.
  const int half_patches = read_asset(path("out/" + name() + ".glb")).half_patches;
  EXPECT_EQ(half_patches > 0, is_open());
  EXPECT_EQ(2 * report["patches"]["count"].get<int>(), 3 * report["domain"]["triangles"].get<int>() + half_patches);
  // The finest level is the source's own where that is lighter than the samples.
  const int steps = report["patches"]["samples"].get<int>() - 1;
  const int sampled = report["domain"]["triangles"].get<int>() * 3 * steps * steps;
  if (report["asset"]["source_triangles"] == 0) {
    EXPECT_LE(report["asset"]["triangles"], sampled);  // fewer where parts have scales of their own
  } else {
    EXPECT_EQ(report["asset"]["triangles"], report["asset"]["source_triangles"]);
  }

  EXPECT_LE(report["asset"]["mean_distance_percent"], 0.1);
  EXPECT_EQ(report["asset"].contains("boundary_max_distance_percent"), is_open());
  if (is_open()) {
    EXPECT_LE(report["asset"]["boundary_max_distance_percent"], kMostAtBoundary);
  }

  std::map<std::string, std::string> files = content_of(path("out"));
  for (const std::string& file : outputs(name(), GetParam().maps)) {
    EXPECT_EQ(files.count(file), 1u) << file;
    const Outcome checked = run({"check", path("out/" + file)});
    EXPECT_EQ(checked.code, 0) << checked.out << checked.err;
  }
  EXPECT_EQ(files.size(), outputs(name(), GetParam().maps).size());
  expect_source_again(path("out/" + name() + ".glb"));
}

/// The files of a build in which one command follows the other.
std::map<std::string, std::string> built_stage_by_stage(const std::string& input, const std::string& name,
                                                        const fs::path& folder,
                                                        const std::vector<std::string>& more_bake = {},
                                                        const std::vector<std::string>& more_export = {},
                                                        const std::vector<std::string>& more_import = {},
                                                        const std::vector<std::string>& more_sample = {},
                                                        std::string_view maps = "normal occlusion ") {
  const auto at = [&](const std::string& file) { return (folder / file).string(); };
  fs::create_directories(folder / "out");
  const std::string image = at("out/" + name + ".gim.exr");
  std::vector<std::string> baked{"--map"};
  for (const std::string& file : outputs(name, maps)) {
    if (file.ends_with(".png")) baked.push_back(at("out/" + file));
  }
  const std::vector<std::vector<std::string>> commands = {
      with({"import", input, "-o", at("a.glb")}, more_import),
      {"parameterize", at("a.glb"), "-o", at("b.glb"), kSmall[0], kSmall[1]},
      with({"sample", at("b.glb"), "-o", at("c.exr")}, more_sample),
      {"pack", at("c.exr"), "-o", image},
      with(with({"bake", at("b.glb"), image, "-o", at("out/" + name)}, {kSmall.begin() + 2, kSmall.end()}), more_bake),
      with(with({"export", image, "--source", at("b.glb"), "-o", at("out/" + name + ".glb")}, baked), more_export)};
  for (const std::vector<std::string>& command : commands) {
    const Outcome outcome = run(command);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
  }
  return content_of(folder / "out");
}

void expect_same(const std::map<std::string, std::string>& a, const std::map<std::string, std::string>& b,
                 const std::string& what) {
  for (const auto& [name, bytes] : a) EXPECT_TRUE(b.count(name) == 1 && b.at(name) == bytes) << name << " " << what;
  EXPECT_EQ(a.size(), b.size()) << what;
}

TEST_P(Build, GivesTheSameBytesOnOneThreadAndOnTwoAndStageByStage) {
  const std::vector<std::string> options = with({"--no-preview", "-q"}, kSmall);
  for (const char* threads : {"1", "2"}) {
    const Outcome built = run(with({"build", input(), "-o", path(threads), "--threads", threads}, options));
    ASSERT_EQ(built.code, 0) << built.err;
    EXPECT_EQ(built.err, "") << "--quiet";
  }
  const auto once = content_of(path("1"));
  EXPECT_EQ(once.size(), outputs(name(), GetParam().maps).size());
  expect_same(once, content_of(path("2")), "with --threads 1 and 2");
  expect_same(once, built_stage_by_stage(input(), name(), folder_ / "stages", {}, {}, {}, {}, GetParam().maps),
              "in memory and stage by stage");
}

INSTANTIATE_TEST_SUITE_P(TestAssets, Build, ::testing::ValuesIn(test_assets::kAssets), test_name);
INSTANTIATE_TEST_SUITE_P(RepairedAssets, Build, ::testing::ValuesIn(test_assets::kRepairedAssets), test_name);
INSTANTIATE_TEST_SUITE_P(OpenAssets, Build, ::testing::ValuesIn(test_assets::kOpenAssets), test_name);

class BuildOnce : public InOwnFolder<> {
 protected:
  std::vector<std::string> command(const std::vector<std::string>& more) const {
    return with(with({"build", test_asset("sphere.glb"), "-q"}, kSmall), more);
  }
};

TEST_F(BuildOnce, GivesTheSameBytesTwiceInARowAndOnOneThreadPreviewIncluded) {
  for (const char* folder : {"first", "second"}) ASSERT_EQ(run(command({"-o", path(folder)})).code, 0);
  ASSERT_EQ(run(command({"-o", path("third"), "--threads", "1"})).code, 0);
  expect_same(content_of(path("first")), content_of(path("second")), "twice in a row");
  expect_same(content_of(path("first")), content_of(path("third")), "on one thread");
  EXPECT_EQ(content_of(path("first")).count("sphere.preview.png"), 1u);
  EXPECT_EQ(run({"check", path("first/sphere.preview.png")}).code, 0);
}

TEST_F(BuildOnce, LeavesNothingWhereItIsStopped) {
  for (const int signal : {SIGINT, SIGTERM}) {
    const Outcome stopped = run_and_signal(command({"-o", path("new/out")}), path("new/out"), signal);
    EXPECT_EQ(stopped.code, 128 + signal) << stopped.err;
    EXPECT_TRUE(content().empty()) << content().begin()->first;
  }
}

TEST_F(BuildOnce, GivesTheSameBytesStageByStageWhateverTheBitsOfTheMaps) {
  for (const std::vector<std::string>& bits : {std::vector<std::string>{"16", "8"}, {"8", "16"}, {"16", "16"}}) {
    const fs::path folder = folder_ / (bits[0] + bits[1]);
    const std::vector<std::string> in_bake = {"--map-bits", bits[0], "--triangles", "20000"};
    const std::vector<std::string> in_export = {"--normal-bits", bits[1], "--triangles", "20000"};
    const std::vector<std::string> in_build = {"--map-bits", bits[0], "--normal-bits", bits[1], "--triangles", "20000"};
    ASSERT_EQ(run(command(with({"-o", (folder / "build").string(), "--no-preview"}, in_build))).code, 0);
    expect_same(content_of(folder / "build"),
                built_stage_by_stage(test_asset("sphere.glb"), "sphere", folder / "stages", in_bake, in_export),
                bits[0] + " and " + bits[1] + " bits");
  }
}

TEST_F(BuildOnce, KeepsToTheTriangleBudgetAndTheMapsFitTheLevelThatItChose) {
  const Outcome built = run(command({"-o", path("out"), "--triangles", "3000", "--no-preview", "--json"}));
  ASSERT_EQ(built.code, 0) << built.err;
  const json report = json::parse(built.out);
  EXPECT_LE(report["asset"]["triangles"], 3000);
  EXPECT_GT(report["asset"]["triangles"], 3000 / 4) << "a finer level would fit";
  EXPECT_EQ(run({"check", path("out/sphere.glb")}).code, 0);
}

TEST_F(BuildOnce, WritesOtherMapsAndSeparateLevelsOnRequest) {
  ASSERT_EQ(run(command({"-o", path("out"), "--no-preview", "--maps", "normal", "object-normal", "position",
                         "--separate-lods", "--lods", "1", "--name", "ball"}))
                .code,
            0);
  std::vector<std::string> names;
  for (const auto& [name, bytes] : content_of(path("out"))) names.push_back(name);
  EXPECT_EQ(names, (std::vector<std::string>{"ball.gim.exr", "ball.gim.json", "ball.glb", "ball.lod1.glb",
                                             "ball.normal.png", "ball.object_normal.png", "ball.position.exr"}));
  for (const std::string& name : names) {
    const Outcome checked = run({"check", path("out/" + name)});
    EXPECT_EQ(checked.code, 0) << name << ": " << checked.out << checked.err;
  }
}

TEST_F(BuildOnce, IsSeenFromBothSidesWhereSomeOfTheSourceIs) {
  const auto double_sided = [&](const std::string& input) {
    EXPECT_EQ(run(with({"build", test_asset(input), "-o", path("out"), "-q", "--no-preview"}, kSmall)).code, 0);
    std::vector<bool> found;
    for (const AssetMaterial& material : read_asset(path("out/" + input)).materials) {
      found.push_back(material.double_sided);
    }
    return found;
  };
  const std::vector<bool> seams = double_sided("seams.glb");
  EXPECT_NE(std::find(seams.begin(), seams.end(), true), seams.end());
  EXPECT_NE(std::find(seams.begin(), seams.end(), false), seams.end()) << "what has one side keeps it";
  const std::vector<bool> sphere = double_sided("sphere.glb");
  EXPECT_EQ(std::find(sphere.begin(), sphere.end(), true), sphere.end());
}

TEST_F(BuildOnce, KeepsTheShapeOfWhatLiesFarFromTheOrigin) {
  const Outcome built =
      run(with({"build", test_asset("far.glb"), "-o", path("out"), "-q", "--finest", "source"}, kSmall));
  ASSERT_EQ(built.code, 0) << built.err;
  const json translation{449123.37, 121.5, -5410987.62};
  EXPECT_EQ(json::parse(content().at("out/far.gim.json"))["translation"], translation);
  EXPECT_EQ(run({"check", path("out/far.glb")}).code, 0);
  const Outcome compared = run({"compare", test_asset("far.glb"), path("out/far.glb"), "--json", "-q"});
  ASSERT_EQ(compared.code, 0) << compared.err;
  // A float has steps of half a unit there.
  EXPECT_LT(json::parse(compared.out)["a_to_b"]["max"].get<double>(), 1e-5) << compared.out;
  EXPECT_EQ(read_asset(path("out/far.glb")).translation, Vec3d(449123.37, 121.5, -5410987.62));
}

TEST_F(BuildOnce, KeepsTheCapOfAHoleOrLeavesItOutAtEveryLevel) {
  // A sphere without one triangle, whose hole is 13 % of the box diagonal around.
  const std::string input = test_asset("bad/open_surface.glb");
  const auto build = [&](const std::string& folder, const std::vector<std::string>& more) {
    const Outcome built = run(
        with(with({"build", input, "-o", path(folder), "-q", "--no-preview", "--fill-holes", "20", "--samples", "17"},
                  kSmall),
             more));
    EXPECT_EQ(built.code, 0) << built.err;
    const Outcome checked = run({"check", path(folder + "/open_surface.glb")});
    EXPECT_EQ(checked.code, 0) << checked.out << checked.err;
    const Outcome again =
        run({"import", path(folder + "/open_surface.glb"), "-o", path("again.glb"), "--fill-holes", "0", "--json"});
    EXPECT_EQ(again.code, 0) << again.err;
    return json::parse(again.out)["source"];
  };
  const json kept = build("kept", {});
  const json open = build("open", {"--caps", "open"});
  EXPECT_EQ(kept["boundary_loops"], 0);
  EXPECT_EQ(open["boundary_loops"], 1);
  EXPECT_LT(open["triangles"], kept["triangles"]);
  for (const std::string file : {"open_surface.gim.exr", "open_surface.normal.png"}) {
    EXPECT_EQ(content_of(path("kept")).at(file), content_of(path("open")).at(file)) << file;
  }
  expect_same(content_of(path("open")),
              built_stage_by_stage(input, "open_surface", folder_ / "stages", {}, {"--caps", "open"},
                                   {"--fill-holes", "20"}, {"--samples", "17"}),
              "in memory and stage by stage");
}

TEST_F(BuildOnce, RefusesToReplaceItsInput) {
  fs::copy_file(test_asset("torus.glb"), path("torus.glb"));
  const auto before = content();
  const Outcome refused = run({"build", path("torus.glb"), "-o", folder_.string()});
  EXPECT_EQ(refused.code, 2) << refused.err;
  EXPECT_NE(refused.err.find("torus.glb: "), std::string::npos) << refused.err;
  EXPECT_EQ(content(), before);
}

TEST_F(BuildOnce, NamesAFolderThatCannotBeWritten) {
  write_text(path("file"), "");
  const auto before = content();
  for (const std::string& folder : {path("file/out"), path("file"), std::string("/proc/lozenge/out")}) {
    const Outcome refused = run(command({"-o", folder}));
    EXPECT_EQ(refused.code, 2) << refused.err;
    EXPECT_NE(refused.err.find(fs::path(folder).parent_path().string()), std::string::npos) << refused.err;
  }
  EXPECT_EQ(content(), before);
}

TEST_F(BuildOnce, NamesAReportThatCannotBeWrittenBeforeItDoesTheWork) {
  const Outcome refused = run(command({"-o", path("out"), "--report", path("nowhere/report.json")}));
  EXPECT_EQ(refused.code, 2) << refused.err;
  EXPECT_NE(refused.err.find("nowhere"), std::string::npos) << refused.err;
  EXPECT_TRUE(content().empty());
}

TEST_F(BuildOnce, LeavesEarlierOutputsAloneWhereItFails) {
  ASSERT_EQ(run(command({"-o", path("out"), "--no-preview"})).code, 0);
  const auto before = content();
  // A surface that closes, under the name of the one before, whose maps don't fit.
  EXPECT_NE(run(command({"-o", path("out"), "--no-preview", "--map-size", "16"})).code, 0);
  EXPECT_EQ(content(), before);
}

}  // namespace
}  // namespace lozenge::end_to_end
