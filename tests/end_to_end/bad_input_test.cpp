// Broken and unfit inputs: each has its exit code and a message that names the file, and nothing is left behind.
#include <algorithm>
#include <cctype>

#include "test_assets/assets.h"
#include "tests/end_to_end/run_program.h"

namespace lozenge::test_assets {

/// How a failed test calls what it ran on.
static void PrintTo(const BadAsset& asset, std::ostream* out) { *out << asset.file; }

}  // namespace lozenge::test_assets

namespace lozenge::end_to_end {
namespace {

namespace fs = std::filesystem;
using test_assets::BadAsset;

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

/// "bad/no_meshes.glb" as "no_meshes_glb".
std::string test_name(const ::testing::TestParamInfo<BadAsset>& info) {
  std::string name(info.param.file.substr(info.param.file.find('/') + 1));
  std::replace(name.begin(), name.end(), '.', '_');
  return name;
}

class BadInput : public InOwnFolder<::testing::TestWithParam<BadAsset>> {
 protected:
  /// The exit code, and one line that says which command, which file and what is wrong.
  void expect_refusal(const Outcome& refused, const std::string& command) const {
    EXPECT_EQ(refused.code, GetParam().exit_code) << refused.err;
    EXPECT_EQ(refused.out, "");
    EXPECT_EQ(std::count(refused.err.begin(), refused.err.end(), '\n'), 1) << refused.err;
    EXPECT_TRUE(refused.err.starts_with("lozenge " + command + ": ")) << refused.err;
    EXPECT_NE(refused.err.find(fs::path(GetParam().file).filename().string()), std::string::npos) << refused.err;
    EXPECT_NE(lower(refused.err).find(GetParam().word), std::string::npos) << refused.err;
    EXPECT_TRUE(content().empty()) << content().begin()->first;
  }
};

TEST_P(BadInput, StopsBuildAndLeavesNothing) {
  expect_refusal(run({"build", test_asset(GetParam().file), "-o", path("new/out"), "-q"}), "build");
}

TEST_P(BadInput, StopsImport) {
  expect_refusal(run({"import", test_asset(GetParam().file), "-o", path("mesh.glb"), "-q"}), "import");
}

INSTANTIATE_TEST_SUITE_P(TestAssets, BadInput, ::testing::ValuesIn(test_assets::kBadAssets), test_name);

class Damaged : public InOwnFolder<> {};

TEST_F(Damaged, SurfacesAreRepairedWithAWordAboutIt) {
  const Outcome taken = run({"import", test_asset("bad/pinched_vertex.glb"), "-o", path("mesh.glb"), "--json"});
  EXPECT_EQ(taken.code, 0) << taken.err;
  EXPECT_NE(taken.out.find("\"bow_tie_vertices\""), std::string::npos) << taken.out;
  EXPECT_NE(taken.err.find("1 vertex parted where pieces touched in a point"), std::string::npos) << taken.err;
  EXPECT_EQ(run({"check", path("mesh.glb")}).code, 0);
  // The file says what is parted, so there is nothing to repair in it.
  const Outcome again = run({"import", path("mesh.glb"), "-o", path("again.glb"), "--strict", "-q"});
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_EQ(content().at("mesh.glb"), content().at("again.glb"));
}

TEST_F(Damaged, SurfacesAreRefusedWhereNoRepairIsAllowed) {
  const Outcome refused =
      run({"import", test_asset("bad/pinched_vertex.glb"), "-o", path("mesh.glb"), "--strict", "-q"});
  EXPECT_EQ(refused.code, 3);
  EXPECT_NE(refused.err.find("pinched_vertex.glb: needs repair"), std::string::npos) << refused.err;
  EXPECT_NE(refused.err.find("1 vertex parted"), std::string::npos) << refused.err;
  EXPECT_TRUE(content().empty());
}

TEST_F(Damaged, HolesAreFilledUpToTheLengthThatIsAskedFor) {
  const auto loops = [&](const std::string& percent) {
    const Outcome taken = run({"import", test_asset("bad/open_surface.glb"), "-o", path("mesh.glb"), "--json", "-q",
                               "--fill-holes", percent});
    EXPECT_EQ(taken.code, 0) << taken.err;
    return taken.out.find("\"boundary_loops\": 1") != std::string::npos;
  };
  EXPECT_TRUE(loops("0"));
  EXPECT_TRUE(loops("2"));
  EXPECT_FALSE(loops("30"));
}

class BadFile : public InOwnFolder<> {};

TEST_F(BadFile, ThatDoesNotExistIsNamed) {
  const Outcome refused = run({"build", path("nothing.glb"), "-o", path("out")});
  EXPECT_EQ(refused.code, 3);
  EXPECT_NE(refused.err.find("nothing.glb: "), std::string::npos) << refused.err;
  EXPECT_TRUE(content().empty());
}

TEST_F(BadFile, FolderInPlaceOfTheInputIsNamed) {
  const Outcome refused = run({"build", folder_.string(), "-o", path("out")});
  EXPECT_EQ(refused.code, 3);
  EXPECT_NE(refused.err.find(folder_.filename().string() + ": "), std::string::npos) << refused.err;
  EXPECT_TRUE(content().empty());
}

TEST_F(BadFile, LargerThanTheLimitsIsRefusedWithTheLimitAndWhatToDo) {
  const auto refuse = [&](const std::vector<std::string>& limit, const std::vector<std::string>& texts) {
    for (std::vector<std::string> command :
         {std::vector<std::string>{"import", test_asset("torus.glb"), "-o", path("mesh.glb"), "-q"},
          std::vector<std::string>{"build", test_asset("torus.glb"), "-o", path("out"), "-q"}}) {
      command.insert(command.end(), limit.begin(), limit.end());
      const Outcome refused = run(command);
      EXPECT_EQ(refused.code, 5) << refused.err;
      for (const std::string& text : texts) EXPECT_NE(refused.err.find(text), std::string::npos) << refused.err;
      EXPECT_TRUE(content().empty());
    }
  };
  refuse({"--max-triangles", "100"}, {"torus.glb: ", "100 triangles", "raise --max-triangles"});
  refuse({"--max-memory", "10k"}, {"torus.glb: ", "the limit is 10 kB", "raise --max-memory"});
  // Enough to import, but not to bake.
  const Outcome refused = run({"build", test_asset("torus.glb"), "-o", path("out"), "-q", "--max-memory", "200M"});
  EXPECT_EQ(refused.code, 5);
  EXPECT_NE(refused.err.find("building from"), std::string::npos) << refused.err;
  EXPECT_EQ(run({"import", test_asset("torus.glb"), "-o", path("mesh.glb"), "--max-memory", "200M"}).code, 0);
}

/// Every command that reads one of our own files, given `file`.
std::vector<std::vector<std::string>> readers(const std::string& file, const std::string& output) {
  return {{"parameterize", file, "-o", output},
          {"sample", file, "-o", output},
          {"pack", file, "-o", output},
          {"check", file},
          {"info", file},
          {"render", file, "-o", output},
          {"compare", file, file}};
}

TEST_F(BadFile, NoCommandTakesAFileOfNoise) {
  std::string noise;
  for (unsigned k = 0, state = 1; k < 10'000; ++k, state = state * 1664525 + 1013904223) noise += char(state >> 24);
  const std::string file = path("noise.exr");
  write_text(file, noise);
  for (std::vector<std::string> command : readers(file, path("out.exr"))) {
    const Outcome refused = run(command);
    EXPECT_EQ(refused.code, 3) << command[0] << ": " << refused.err;
    EXPECT_NE(refused.err.find(fs::path(file).filename().string() + ": "), std::string::npos)
        << command[0] << ": " << refused.err;
    EXPECT_EQ(content().size(), 1u) << command[0];
  }
}

TEST_F(BadFile, NoCommandTakesTheFileOfAnotherStage) {
  const std::string file = path("mesh.glb");
  ASSERT_EQ(run({"import", test_asset("torus.glb"), "-o", file}).code, 0);
  for (const char* command : {"sample", "pack"}) {
    const Outcome refused = run({command, file, "-o", path("out.exr")});
    EXPECT_EQ(refused.code, 3) << command << ": " << refused.err;
    EXPECT_NE(refused.err.find(fs::path(file).filename().string() + ": "), std::string::npos)
        << command << ": " << refused.err;
    EXPECT_EQ(content().size(), 1u) << command;
  }
}

}  // namespace
}  // namespace lozenge::end_to_end
