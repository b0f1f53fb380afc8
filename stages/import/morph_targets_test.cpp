// Morph targets: which are kept, what they are called, what moves them, and what they part.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "formats/base/error.h"
#include "formats/files/source_mesh_file.h"
#include "formats/surface/attribute_streams.h"
#include "formats/surface/body_fixtures.h"
#include "stages/import/gltf_fixtures.h"
#include "stages/import/import_surface.h"

namespace lozenge {
namespace {

using namespace testing_gltf;

class MorphTargets : public testing::Test {
 protected:
  SourceMesh import(TestGltf gltf, ImportReport* report = nullptr) const {
    write_bytes(folder_ / "asset.glb", gltf.glb());
    return import_asset(folder_ / "asset.glb", {}, {}, report);
  }

  ExitCode code_of(const TestGltf& gltf) const {
    try {
      import(gltf);
    } catch (const Error& e) {
      EXPECT_NE(std::string(e.what()).find("asset.glb"), std::string::npos) << e.what();
      return e.code();
    }
    return ExitCode::kDone;
  }

  fixtures::TestFolder folder_;
};

json& primitive_of(TestGltf& gltf) { return gltf.document["meshes"][0]["primitives"][0]; }

/// A tetrahedron with a target that moves its first corner by (1, 2, 3), one that does nothing, and one that moves all.
TestGltf morphing() {
  TestGltf gltf = tetrahedron();
  std::vector<float> one(12, 0.0F);
  one[0] = 1;
  one[1] = 2;
  one[2] = 3;
  const int first = gltf.add_values(one, "VEC3", kFloat);
  const int none = gltf.add_accessor({{"componentType", kFloat}, {"type", "VEC3"}, {"count", 4}});
  const int all = gltf.add_values(std::vector<float>(12, 0.5F), "VEC3", kFloat);
  primitive_of(gltf)["targets"] = {{{"POSITION", first}}, {{"POSITION", none}}, {{"POSITION", all}}};
  gltf.document["meshes"][0]["weights"] = {0.5, 1, 0};
  gltf.document["meshes"][0]["extras"] = {{"targetNames", {"one", "none", "all"}}};
  return gltf;
}

void animate_weights(TestGltf& gltf, const std::vector<float>& values, std::size_t keys) {
  std::vector<float> times;
  for (std::size_t k = 0; k < keys; ++k) times.push_back(static_cast<float>(k));
  const int input = gltf.add_values(times, "SCALAR", kFloat);
  const int output = gltf.add_values(values, "SCALAR", kFloat);
  gltf.document["animations"].push_back(
      {{"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "weights"}}}}}},
       {"samplers", {{{"input", input}, {"output", output}}}}});
}

TEST_F(MorphTargets, AreKeptWhereTheyDoAnything) {
  ImportReport report;
  const SourceMesh mesh = import(morphing(), &report);
  ASSERT_EQ(mesh.bodies.bodies.size(), 1U);
  EXPECT_EQ(mesh.bodies.bodies[0].targets, (std::vector<MorphTarget>{{"one", 0.5}, {"all", 0}}));
  ASSERT_EQ(report.notes.size(), 1U);
  EXPECT_NE(report.notes[0].find("1 morph target left out that moves nothing"), std::string::npos) << report.notes[0];
  const AttributeStream* one = find_stream(mesh.corner_attributes, kMorphOffsets, 0);
  ASSERT_NE(one, nullptr);
  for (std::size_t c = 0; c < one->count(); ++c) {
    const Vec3f& p = mesh.positions[mesh.triangles[c / 3][c % 3]];
    EXPECT_EQ(vector_at<Vec3f>(*one, c), p == Vec3f(1, 1, 1) ? Vec3f(1, 2, 3) : Vec3f(0, 0, 0));
  }
}

TEST_F(MorphTargets, AreAnimatedByThoseWeightsThatAreTheirs) {
  TestGltf gltf = morphing();
  animate_weights(gltf, {1, 2, 3, 4, 5, 6}, 2);
  const SourceMesh mesh = import(gltf);
  ASSERT_EQ(mesh.rig.animations.size(), 1U);
  EXPECT_EQ(mesh.rig.animations[0].samplers.at(0).values, (std::vector<float>{1, 3, 4, 6}));
  EXPECT_EQ(mesh.rig.animations[0].samplers.at(0).components, 2);

  TestGltf short_of_keys = morphing();
  animate_weights(short_of_keys, {1, 2, 3, 4, 5}, 2);
  EXPECT_TRUE(import(short_of_keys).rig.animations.empty());
}

TEST_F(MorphTargets, HaveTheWeightsOfTheirNodeBeforeThoseOfTheMesh) {
  TestGltf gltf = morphing();
  gltf.document["nodes"][0]["weights"] = {0.125, 1, 0.75};
  EXPECT_EQ(import(gltf).bodies.bodies.at(0).targets, (std::vector<MorphTarget>{{"one", 0.125}, {"all", 0.75}}));
}

TEST_F(MorphTargets, PartWhatLiesTogetherAtRest) {
  // Two squares that share an edge at rest, as lips do; each has corners of its own there.
  const std::vector<Vec3f> positions{{0, 0, 0}, {1, 0, 0}, {1, 1, 0},  {0, 1, 0},
                                     {0, 0, 0}, {1, 0, 0}, {1, -1, 0}, {0, -1, 0}};
  const std::vector<std::uint32_t> indices{0, 1, 2, 0, 2, 3, 4, 6, 5, 4, 7, 6};
  for (const float gap : {0.0F, 0.25F}) {
    TestGltf gltf;
    gltf.add_simple_mesh(positions, indices);
    std::vector<float> offsets(24, 0.0F);
    for (const std::size_t v : {0U, 1U, 2U, 3U}) offsets[3 * v + 1] = 1;
    for (const std::size_t v : {4U, 5U}) offsets[3 * v + 1] = 1 - gap;
    primitive_of(gltf)["targets"] = {{{"POSITION", gltf.add_values(offsets, "VEC3", kFloat)}}};
    EXPECT_EQ(import(gltf).positions.size(), gap == 0 ? 6U : 8U);
  }
}

TEST_F(MorphTargets, AreOfOneBodyForEachPlaceOfAMesh) {
  TestGltf gltf = morphing();
  gltf.add_node({{"mesh", 0}, {"translation", {9, 0, 0}}, {"weights", {0, 0, 1}}});
  const SourceMesh mesh = import(gltf);
  ASSERT_EQ(mesh.bodies.bodies.size(), 2U);
  EXPECT_EQ(mesh.triangles.size(), 8U);
  EXPECT_EQ(mesh.bodies.bodies[1].targets.at(1).weight, 1);
}

TEST_F(MorphTargets, ComeBackFromTheMeshsOwnFile) {
  TestGltf gltf = morphing();
  gltf.document["nodes"][0]["name"] = "face";
  animate_weights(gltf, {1, 2, 3, 4, 5, 6}, 2);
  const SourceMesh mesh = import(gltf);
  write_source_mesh(folder_ / "asset.mesh.glb", mesh);
  for (const SourceMesh& back :
       {read_source_mesh(folder_ / "asset.mesh.glb"), import_asset(folder_ / "asset.mesh.glb")}) {
    expect_same_mesh(back, mesh);
    fixtures::expect_same(back.bodies, mesh.bodies);
    fixtures::expect_same(back.rig, mesh.rig);
  }
}

TEST_F(MorphTargets, AndTheirNodeComeBackThoughNothingIsSaidOfThat) {
  const SourceMesh mesh = import(morphing());
  ASSERT_EQ(mesh.rig.nodes.size(), 1U);
  write_source_mesh(folder_ / "asset.mesh.glb", mesh);
  EXPECT_EQ(read_source_mesh(folder_ / "asset.mesh.glb").rig.nodes.size(), 1U);
}

TEST_F(MorphTargets, AreLeftOutOrRefusedWhereTheyAreNone) {
  const auto code_after = [&](const std::function<void(json&)>& change) {
    TestGltf gltf = morphing();
    change(primitive_of(gltf)["targets"]);
    return code_of(gltf);
  };
  EXPECT_EQ(code_after([](json&) {}), ExitCode::kDone);
  // What the document itself shows to be none is left out, and the mesh comes through.
  EXPECT_EQ(code_after([](json& targets) { targets[0]["POSITION"] = 99; }), ExitCode::kDone);
  EXPECT_EQ(code_after([](json& targets) { targets[0]["POSITION"] = "no"; }), ExitCode::kDone);
  EXPECT_EQ(code_after([](json& targets) { targets = 5; }), ExitCode::kDone);
  EXPECT_EQ(code_after([](json& targets) { targets[0] = 5; }), ExitCode::kDone);
  EXPECT_EQ(code_after([](json& targets) { targets[0]["_OTHER"] = 2; }), ExitCode::kDone);
  EXPECT_EQ(code_after([](json& targets) { targets[0]["POSITION"] = 1; }), ExitCode::kUnusableInput) << "indices";
}

}  // namespace
}  // namespace lozenge
