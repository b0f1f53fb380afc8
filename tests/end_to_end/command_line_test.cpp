// The command line itself: help, wrong usage, what goes to stdout and what to stderr.
#include <nlohmann/json.hpp>

#include "tests/end_to_end/run_program.h"

namespace lozenge::end_to_end {
namespace {

const std::vector<std::string> kCommands = {"build", "unwrap", "import", "parameterize", "sample", "pack",
                                            "bake",  "export", "check",  "compare",      "info",   "render", "batch", "cache"};

class CommandLine : public InOwnFolder<> {
 protected:
  void expect_wrong_usage(const std::vector<std::string>& arguments, const std::string& word) const {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.code, 2) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    EXPECT_NE(outcome.err.find(word), std::string::npos) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_TRUE(content().empty());
  }
};

TEST_F(CommandLine, EveryCommandHasHelpWithExamplesOfItself) {
  for (const std::string& command : kCommands) {
    const Outcome help = run({command, "--help"});
    EXPECT_EQ(help.code, 0) << command;
    EXPECT_EQ(help.err, "") << command;
    EXPECT_NE(help.out.find("lozenge " + command + " "), std::string::npos) << help.out;
    for (const char* option : {"--threads", "--json", "--quiet", "Examples"}) {
      EXPECT_NE(help.out.find(option), std::string::npos) << command << " has no " << option;
    }
  }
}

TEST_F(CommandLine, HelpListsEveryCommandAndTheExitCodes) {
  const Outcome help = run({"--help"});
  EXPECT_EQ(help.code, 0);
  for (const std::string& command : kCommands) EXPECT_NE(help.out.find("  " + command), std::string::npos) << command;
  EXPECT_NE(help.out.find("Exit codes"), std::string::npos);
}

TEST_F(CommandLine, LoadsNeitherImagesNorRaysForTheStagesOfSurfaces) {
  const auto asks_for = [](const std::filesystem::path& program, const char* library) {
    return read_text(program).find(library) != std::string::npos;
  };
  const std::filesystem::path program = LOZENGE_PROGRAM, whole = program.parent_path() / "lozenge-whole";
  for (const char* library : {"libOpenImageIO.so", "libembree"}) {
    EXPECT_FALSE(asks_for(program, library)) << library;
    EXPECT_TRUE(asks_for(whole, library)) << library;
  }
}

TEST_F(CommandLine, SaysWhatIsMissingWhereItStandsAlone) {
  const std::string alone = path("lozenge");
  std::filesystem::copy_file(LOZENGE_PROGRAM, alone);
  const Outcome outcome = run({"info", "a.glb"}, alone);
  EXPECT_EQ(outcome.code, 1);
  EXPECT_NE(outcome.err.find("lozenge-whole"), std::string::npos) << outcome.err;
  EXPECT_EQ(run({"pack", "--help"}, alone).code, 0);
  std::filesystem::remove(alone);
}

TEST_F(CommandLine, TellsItsVersion) {
  const Outcome version = run({"--version"});
  EXPECT_EQ(version.code, 0);
  EXPECT_TRUE(version.out.starts_with("lozenge ")) << version.out;
}

TEST_F(CommandLine, WrongUsageIsOneLineAndExitCode2) {
  const std::string in = path("in.glb"), out = path("out");
  expect_wrong_usage({}, "--help");
  expect_wrong_usage({"frobnicate"}, "frobnicate");
  expect_wrong_usage({"build"}, "input");
  expect_wrong_usage({"build", in}, "--output");
  expect_wrong_usage({"build", in, "-o", out, "--frobnicate"}, "--frobnicate");
  expect_wrong_usage({"build", in, "-o", out, "--samples", "18"}, "2^k + 1");
  expect_wrong_usage({"build", in, "-o", out, "--samples", "many"}, "--samples");
  expect_wrong_usage({"build", in, "-o", out, "--domain-faces", "200..100"}, "backwards");
  expect_wrong_usage({"build", in, "-o", out, "--domain-faces", "1..2"}, "--domain-faces");
  expect_wrong_usage({"build", in, "-o", out, "--domain-faces", "100-200"}, "100..200");
  expect_wrong_usage({"build", in, "-o", out, "--threads", "0"}, "--threads");
  expect_wrong_usage({"build", in, "-o", out, "--threads", "-1"}, "--threads");
  expect_wrong_usage({"build", in, "-o", out, "--map-size", "1"}, "--map-size");
  expect_wrong_usage({"build", in, "-o", out, "--map-bits", "12"}, "--map-bits");
  expect_wrong_usage({"build", in, "-o", out, "--maps", "colour"}, "--maps");
  expect_wrong_usage({"sample", in, "-o", out, "--partition", "stars"}, "--partition");
  expect_wrong_usage({"sample", in, "-o", out, "--partition", "faces", "--samples", "17"}, "--samples");
  expect_wrong_usage({"export", in, "-o", out, "--caps", "closed"}, "--caps");
  expect_wrong_usage({"render", in, "-o", out, "--style", "oil"}, "--style");
  expect_wrong_usage({"compare", in}, "b");
  expect_wrong_usage({"check"}, "files");
}

TEST_F(CommandLine, AWrongValueIsToldWhichOnesThereAre) {
  const std::string in = path("in.glb"), out = path("out");
  expect_wrong_usage({"build", in, "-o", out, "--maps", "colour"},
                     "none of normal, object-normal, occlusion, position");
  expect_wrong_usage({"build", in, "-o", out, "--maps", "0"}, "none of normal");
  expect_wrong_usage({"build", in, "-o", out, "--map-bits", "12"}, "'12' is none of 8, 16");
  expect_wrong_usage({"build", in, "-o", out, "--map-size", "1"}, "'1' is not in the range 16 to 16384");
  expect_wrong_usage({"build", in, "-o", out, "--triangles", "1e5"}, "'1e5' is not a whole number from 1 on");
  expect_wrong_usage({"build", in, "-o", out, "--cage", "0"}, "'0' is not a positive number");
}

TEST_F(CommandLine, JsonIsAllThatGoesToStdout) {
  const std::string file = path("torus.glb");
  ASSERT_EQ(run({"import", test_asset("torus.glb"), "-o", file}).code, 0);
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"info", file, "--json"},
        {"check", file, "--json"},
        {"compare", file, file, "--json"},
        {"import", file, "-o", path("mesh.glb"), "--json"},
        {"render", file, "-o", path("picture.png"), "--width", "64", "--height", "64", "--json"}}) {
    const Outcome outcome = run(command);
    EXPECT_EQ(outcome.code, 0) << command[0] << ": " << outcome.err;
    EXPECT_TRUE(nlohmann::json::accept(outcome.out)) << command[0] << ": " << outcome.out;
  }
}

TEST_F(CommandLine, ImportTellsWhatIsPlacedMoreThanOnce) {
  // Both halves of its ring are one mesh.
  const Outcome outcome = run({"import", test_asset("seams.glb"), "-o", path("mesh.glb"), "--json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(nlohmann::json::parse(outcome.out)["instances"],
            nlohmann::json::parse(R"({"placed": 3, "repeated": 2, "copies": 0})"));
  EXPECT_NE(outcome.err.find("2 placements of meshes that are placed more than once"), std::string::npos)
      << outcome.err;
}

TEST_F(CommandLine, ALogHasNoControlCharacters) {
  const Outcome outcome = run({"import", test_asset("torus.glb"), "-o", path("mesh.glb")});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ((outcome.out + outcome.err).find_first_of("\r\033"), std::string::npos);
}

TEST_F(CommandLine, QuietLeavesResultsAndErrors) {
  const Outcome done = run({"import", test_asset("torus.glb"), "-o", path("mesh.glb"), "--quiet"});
  EXPECT_EQ(done.err, "");
  EXPECT_NE(done.out, "");
  const Outcome failed = run({"import", path("nothing.glb"), "-o", path("other.glb"), "--quiet"});
  EXPECT_NE(failed.err, "");
}

}  // namespace
}  // namespace lozenge::end_to_end
