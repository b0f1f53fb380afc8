// What somebody meets who tries the commands one after the other, on files as they come.
#include <gtest/gtest.h>

#include <cstring>
#include <nlohmann/json.hpp>

#include "tests/end_to_end/run_program.h"

namespace lozenge::end_to_end {
namespace {

using nlohmann::json;

class FirstSteps : public InOwnFolder<> {
 protected:
  void expect_done(const std::vector<std::string>& arguments) const {
    const Outcome outcome = run(arguments);
    ASSERT_EQ(outcome.code, 0) << arguments[0] << ": " << outcome.err;
  }
  void expect_refusal(const std::vector<std::string>& arguments, int code, const std::string& message) const {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.code, code) << arguments[0] << ": " << outcome.err;
    EXPECT_NE(outcome.err.find(message), std::string::npos) << outcome.err;
  }
};

std::uint32_t word_at(const std::string& bytes, std::size_t at) {
  std::uint32_t word = 0;
  std::memcpy(&word, bytes.data() + at, sizeof word);
  return word;
}

/// A GLB whose JSON was changed, as another tool would write it.
template <typename Change>
void repack(const std::string& from, const std::string& to, const Change& change) {
  std::string bytes = read_text(from);
  const std::uint32_t length = word_at(bytes, 12);
  json document = json::parse(bytes.substr(20, length));
  change(document);
  std::string text = document.dump();
  text.resize((text.size() + 3) / 4 * 4, ' ');
  const auto put = [&](std::size_t at, std::uint32_t word) { std::memcpy(bytes.data() + at, &word, sizeof word); };
  bytes.replace(20, length, text);
  put(8, static_cast<std::uint32_t>(bytes.size()));
  put(12, static_cast<std::uint32_t>(text.size()));
  write_text(to, bytes);
}

TEST_F(FirstSteps, ParameterizeImportsAnAssetByItself) {
  const std::string asset = test_asset("torus.glb");
  expect_done({"import", asset, "-o", path("mesh.glb")});
  expect_done({"parameterize", path("mesh.glb"), "-o", path("two.glb"), "--domain-faces", "40..60"});
  expect_done({"parameterize", asset, "-o", path("one.glb"), "--domain-faces", "40..60"});
  EXPECT_EQ(read_text(path("one.glb")), read_text(path("two.glb")));
  expect_refusal({"parameterize", asset, "-o", path("no.glb"), "--max-triangles", "100"}, 5, "raise --max-triangles");
}

TEST_F(FirstSteps, EachCommandTellsWhichOneMakesItsInput) {
  const std::string asset = test_asset("torus.glb");
  const std::string name = "torus.glb: is an asset; ";
  expect_refusal({"sample", asset, "-o", path("x.exr")}, 3,
                 name + "`lozenge parameterize` makes the map that `sample` needs");
  expect_refusal({"pack", asset, "-o", path("x.exr")}, 3,
                 name + "`lozenge sample` makes the patch set that `pack` needs");
  expect_refusal({"export", asset, "-o", path("x.glb")}, 3,
                 name + "`lozenge pack` makes the geometry image that `export` needs");
  expect_refusal({"bake", asset, asset, "-o", path("x")}, 3,
                 name + "`lozenge parameterize` makes the map that `bake` needs");
  expect_done({"import", asset, "-o", path("mesh.glb")});
  expect_refusal({"sample", path("mesh.glb"), "-o", path("x.exr")}, 3,
                 "mesh.glb: is a surface; `lozenge parameterize`");
}

TEST_F(FirstSteps, StagesTellTheFilesOfOtherStagesApart) {
  expect_done({"build", test_asset("cube.glb"), "-o", folder_.string(), "--name", "s", "--domain-faces", "20..30",
               "--samples", "5", "--map-size", "128"});
  expect_refusal({"sample", path("s.glb"), "-o", path("x.exr")}, 3, "s.glb: is an asset; `lozenge parameterize`");
  expect_refusal({"pack", path("s.gim.exr"), "-o", path("x.exr")}, 3,
                 "s.gim.exr: is a geometry image; `lozenge sample` makes the patch set");
  expect_refusal({"sample", path("s.normal.png"), "-o", path("x.exr")}, 3, "s.normal.png: is a texture; ");
  expect_refusal({"sample", path("s.preview.png"), "-o", path("x.exr")}, 3, "s.preview.png: is a picture; ");
  expect_refusal({"export", path("s.gim.exr"), "--map", path("s.preview.png"), "-o", path("x.glb")}, 3,
                 "s.preview.png: is a picture; `lozenge bake` makes the texture that `export` needs");
}

TEST_F(FirstSteps, InfoTellsAboutWhatAnotherToolRepackedFromOurs) {
  expect_done({"parameterize", test_asset("cube.glb"), "-o", path("map.glb"), "--domain-faces", "20..30"});
  expect_done({"import", test_asset("cube.glb"), "-o", path("mesh.glb")});
  expect_done({"build", test_asset("cube.glb"), "-o", folder_.string(), "--name", "s", "--domain-faces", "20..30",
               "--samples", "5", "--map-size", "128"});
  const auto expect_told = [&](const std::string& file) {
    const Outcome told = run({"info", file, "--json"});
    ASSERT_EQ(told.code, 0) << told.err;
    const json facts = json::parse(told.out);
    EXPECT_EQ(facts["kind"], "glTF asset") << told.out;
    EXPECT_GT(facts["triangles"], 0) << told.out;
    EXPECT_TRUE(facts.contains("changed")) << told.out;
  };
  for (const char* file : {"map.glb", "mesh.glb"}) {
    // As a tool does that keeps extras and drops attributes that it doesn't know.
    repack(path(file), path("repacked.glb"), [](json& document) {
      document["asset"]["extras"]["lozenge"]["triangles"] = 7;
      for (json& primitive : document["meshes"][0]["primitives"]) primitive["attributes"].erase("_DOMAIN_TRIANGLE");
    });
    expect_told(path("repacked.glb"));
  }
  repack(path("s.glb"), path("repacked.glb"), [](json& document) { document["asset"]["extras"]["parts"] = 7; });
  expect_told(path("repacked.glb"));
}

TEST_F(FirstSteps, MapsThatAreTooSmallAreToldBeforeTheWork) {
  const Outcome small =
      run({"build", test_asset("torus.glb"), "-o", path("out"), "--domain-faces", "100..200", "--map-size", "64"});
  EXPECT_EQ(small.code, 5) << small.err;
  EXPECT_NE(small.err.find("torus.glb: 150 patches"), std::string::npos) << small.err;
  EXPECT_NE(small.err.find("--map-size "), std::string::npos) << small.err;
  EXPECT_EQ(small.err.find("parameterize"), std::string::npos) << small.err;
  EXPECT_TRUE(content().empty());
}

}  // namespace
}  // namespace lozenge::end_to_end
