// What moves is kept apart from what doesn't: animated nodes, their children, skins, props on bones.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "formats/base/error.h"
#include "formats/files/source_mesh_file.h"
#include "formats/surface/body_fixtures.h"
#include "stages/import/gltf_fixtures.h"
#include "stages/import/import_surface.h"

namespace lozenge {
namespace {

using namespace testing_gltf;

class MovingBodies : public testing::Test {
 protected:
  SourceMesh import(TestGltf gltf, ImportReport* report = nullptr, Instances instances = Instances::kShared) const {
    write_bytes(folder_ / "asset.glb", gltf.glb());
    return import_asset(folder_ / "asset.glb", {.instances = instances}, {}, report);
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

/// Adds an animation that moves a property of a node: keys of as many numbers as that has.
void animate(TestGltf& gltf, int node, const std::string& path, const std::vector<float>& keys,
             const std::string& interpolation = "LINEAR") {
  const std::size_t components = path == "rotation" ? 4 : 3;
  const std::size_t count = keys.size() / components / (interpolation == "CUBICSPLINE" ? 3 : 1);
  std::vector<float> times;
  for (std::size_t k = 0; k < count; ++k) times.push_back(static_cast<float>(k));
  const int input = gltf.add_values(times, "SCALAR", kFloat);
  const int output = gltf.add_values(keys, components == 4 ? "VEC4" : "VEC3", kFloat);
  gltf.document["animations"].push_back(
      {{"name", path},
       {"channels", {{{"sampler", 0}, {"target", {{"node", node}, {"path", path}}}}}},
       {"samplers", {{{"input", input}, {"output", output}, {"interpolation", interpolation}}}}});
}

/// Two tetrahedra in one place: node 0, and node 1 below node 2.
TestGltf two_nodes() {
  TestGltf gltf = tetrahedron();
  gltf.document["nodes"] = json::array();
  gltf.add_node({{"name", "still"}, {"mesh", 0}});
  gltf.add_node({{"name", "child"}, {"mesh", 0}, {"scale", {2, 2, 2}}});
  gltf.add_node({{"name", "parent"}, {"translation", {-1, -1, -1}}, {"children", {1}}});
  return gltf;
}

TEST_F(MovingBodies, AreNeverWeldedToOthers) {
  // The child's first corner is the other's.
  EXPECT_EQ(import(two_nodes()).positions.size(), 7U) << "as long as nothing moves";
  TestGltf gltf = two_nodes();
  animate(gltf, 1, "translation", {0, 0, 0, 0, 5, 0});
  const SourceMesh mesh = import(gltf);
  EXPECT_EQ(mesh.positions.size(), 8U);
  ASSERT_EQ(mesh.bodies.bodies.size(), 1U);
  EXPECT_EQ(mesh.bodies.bodies[0].name, "child");
  ASSERT_EQ(mesh.rig.nodes.size(), 2U);
  EXPECT_EQ(mesh.rig.nodes[0].name, "parent");
  EXPECT_EQ(mesh.rig.nodes[1].name, "child");
  EXPECT_EQ(mesh.rig.nodes[1].parent, 0);
  ASSERT_EQ(mesh.rig.animations.size(), 1U);
  EXPECT_EQ(mesh.rig.animations[0].name, "translation");
  EXPECT_EQ(mesh.rig.animations[0].channels.at(0).node, 1);
  EXPECT_EQ(mesh.rig.animations[0].samplers.at(0).values, (std::vector<float>{0, 0, 0, 0, 5, 0}));
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    EXPECT_EQ(mesh.bodies.owner_of(mesh.materials[t]), t < 4 ? 0 : -1);
  }
}

TEST_F(MovingBodies, AreNoneWhereNothingThatMovesHasTriangles) {
  TestGltf gltf = two_nodes();
  animate(gltf, 1, "translation", {0, 0, 0, 0, 5, 0});
  gltf.document["nodes"][1]["mesh"] = 1;
  gltf.document["meshes"].push_back(gltf.document["meshes"][0]);
  gltf.document["meshes"][1]["primitives"][0]["indices"] = 0;  // positions
  const SourceMesh mesh = import(gltf);
  EXPECT_EQ(mesh.triangles.size(), 4U);
  EXPECT_TRUE(mesh.bodies.empty());
  EXPECT_TRUE(mesh.rig.empty());
}

TEST_F(MovingBodies, StandWhereTheirNodesDoAtRest) {
  TestGltf gltf = two_nodes();
  animate(gltf, 2, "rotation", {0, 0, 0, 1, 1, 0, 0, 0});
  const SourceMesh mesh = import(gltf);
  ASSERT_EQ(mesh.bodies.bodies.size(), 1U) << "moved by its parent";
  const BodyPlace& place = mesh.bodies.bodies[0].places.at(0);
  EXPECT_EQ(place.node, 1);
  EXPECT_EQ(placed(place.placement, {1, 1, 1}), Vec3f(1, 1, 1));
  EXPECT_EQ(placed(place.placement, {-1, -1, 1}), Vec3f(-3, -3, 1));
  const std::vector<Vec3f> corners(mesh.positions.begin(), mesh.positions.begin() + 4);
  for (const Vec3f& p : tetrahedron_positions()) {
    EXPECT_EQ(std::count(corners.begin(), corners.end(), placed(place.placement, p)), 1);
  }
}

TEST_F(MovingBodies, AreNoneWhereKeysNeverLeaveTheRest) {
  const auto bodies_after = [&](const std::function<void(TestGltf&)>& change) {
    TestGltf gltf = two_nodes();
    gltf.document["nodes"][2]["rotation"] = {0.6, 0, 0, 0.8};
    change(gltf);
    const SourceMesh mesh = import(gltf, nullptr, Instances::kSeparate);
    EXPECT_EQ(mesh.rig.empty(), mesh.bodies.empty());
    return mesh.bodies.bodies.size();
  };
  const std::vector<float> at_rest{0, 0, 0, -1, -1, -1, 0, 0, 0};
  std::vector<float> with_tangents = at_rest;
  with_tangents[8] = 0.5F;
  EXPECT_EQ(bodies_after([](TestGltf& g) { animate(g, 2, "translation", {-1, -1, -1, -1, -1, -1}); }), 0U);
  EXPECT_EQ(bodies_after([](TestGltf& g) { animate(g, 2, "rotation", {0.6F, 0, 0, 0.8F, 0.6F, 0, 0, 0.8F}); }), 0U);
  EXPECT_EQ(bodies_after([](TestGltf& g) { animate(g, 2, "rotation", {-0.6F, 0, 0, -0.8F}); }), 0U) << "the same turn";
  EXPECT_EQ(bodies_after([](TestGltf& g) { animate(g, 2, "scale", {1, 1, 1}, "STEP"); }), 0U);
  EXPECT_EQ(bodies_after([&](TestGltf& g) { animate(g, 2, "translation", at_rest, "CUBICSPLINE"); }), 0U);
  EXPECT_EQ(bodies_after([&](TestGltf& g) { animate(g, 2, "translation", with_tangents, "CUBICSPLINE"); }), 1U);
  EXPECT_EQ(bodies_after([](TestGltf& g) { animate(g, 2, "translation", {-1, -1, -1, -1, -1.25F, -1}); }), 1U);
  EXPECT_EQ(bodies_after([](TestGltf& g) { animate(g, 2, "scale", {1, 1, 2}, "STEP"); }), 1U) << "one key, elsewhere";
}

TEST_F(MovingBodies, ShareTheSurfaceOfARepeatedMesh) {
  TestGltf gltf = two_nodes();
  gltf.add_node({{"name", "other"}, {"mesh", 0}, {"translation", {9, 0, 0}}, {"scale", {-1, 1, 1}}});
  animate(gltf, 1, "translation", {0, 0, 0, 0, 5, 0});
  animate(gltf, 3, "translation", {9, 0, 0, 0, 5, 0});
  const SourceMesh mesh = import(gltf);
  EXPECT_EQ(mesh.triangles.size(), 8U) << "one stands still, the others are one";
  ASSERT_EQ(mesh.bodies.bodies.size(), 1U);
  ASSERT_EQ(mesh.bodies.bodies[0].places.size(), 2U);
  EXPECT_EQ(placed(copies_of(mesh.bodies.bodies[0]).at(0), {1, 1, 1}), Vec3f(8, 1, 1));
  EXPECT_EQ(mesh.rig.nodes.at(static_cast<std::size_t>(mesh.bodies.bodies[0].places[1].node)).name, "other");
}

TEST_F(MovingBodies, ThatAreHiddenAtRestStandAsIfTheyWereNot) {
  TestGltf gltf = two_nodes();
  gltf.document["nodes"][1]["scale"] = {0, 0, 0};
  animate(gltf, 1, "scale", {0, 0, 0, 1, 1, 1});
  ImportReport report;
  EXPECT_EQ(import(gltf, &report).triangles.size(), 8U);
  EXPECT_NE(report.notes.front().find("1 node has no extent at rest"), std::string::npos) << report.notes.front();
}

TEST_F(MovingBodies, AreSurfaceOfTheirOwnWhereTheyAreShearedAgainstEachOther) {
  TestGltf gltf = two_nodes();
  gltf.add_node({{"name", "other"}, {"mesh", 0}, {"rotation", {0.6, 0, 0, 0.8}}});
  gltf.add_node({{"name", "above"}, {"translation", {9, 0, 0}}, {"scale", {1, 1, 3}}, {"children", {3}}});
  animate(gltf, 1, "translation", {0, 0, 0, 0, 5, 0});
  animate(gltf, 3, "translation", {9, 0, 0, 0, 5, 0});
  EXPECT_EQ(import(gltf).bodies.bodies.size(), 2U);
}

/// A strip of four quads up along z, two joints wide apart, in a space a hundred times as large; the skin stands
/// upright along y. A tetrahedron hangs on the upper joint.
TestGltf skinned_strip() {
  TestGltf gltf;
  std::vector<Vec3f> positions;
  std::vector<std::uint8_t> joints;
  std::vector<float> weights;
  for (int row = 0; row < 5; ++row) {
    for (const float x : {-50.0F, 50.0F}) {
      positions.emplace_back(x, 0.0F, 50.0F * static_cast<float>(row));
      joints.insert(joints.end(), {0, 1, 0, 0});
      weights.insert(weights.end(), {1 - 0.25F * static_cast<float>(row), 0.25F * static_cast<float>(row), 0, 0});
    }
  }
  std::vector<std::uint32_t> indices;
  for (std::uint32_t row = 0; row < 4; ++row) {
    const std::uint32_t a = 2 * row;
    indices.insert(indices.end(), {a, a + 1, a + 2, a + 1, a + 3, a + 2});
  }
  gltf.add_simple_mesh(positions, indices);
  json& attributes = gltf.document["meshes"][0]["primitives"][0]["attributes"];
  attributes["JOINTS_0"] = gltf.add_values(joints, "VEC4", kUnsignedByte);
  attributes["WEIGHTS_0"] = gltf.add_values(weights, "VEC4", kFloat);
  const std::vector<float> binds{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0,    1,
                                 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, -100, 1};
  const int view = gltf.add_view(binds);
  const int matrices =
      gltf.add_accessor({{"bufferView", view}, {"componentType", kFloat}, {"type", "MAT4"}, {"count", 2}});
  gltf.document["skins"] = {{{"name", "bones"}, {"joints", {2, 3}}, {"inverseBindMatrices", matrices}}};
  gltf.document["nodes"][0] = {{"mesh", 0}, {"skin", 0}, {"translation", {7, 7, 7}}};
  const double h = std::sqrt(0.5);
  gltf.add_node({{"name", "armature"}, {"scale", {0.01, 0.01, 0.01}}, {"rotation", {-h, 0, 0, h}}, {"children", {2}}});
  gltf.add_node({{"name", "lower"}, {"children", {3}}});
  gltf.add_node({{"name", "upper"}, {"translation", {0, 0, 100}}, {"children", {4}}});
  gltf.add_simple_mesh(tetrahedron_positions(), tetrahedron_indices());
  gltf.document["nodes"][4]["name"] = "prop";
  return gltf;
}

TEST_F(MovingBodies, OfSkinsStandInTheirRestPose) {
  const SourceMesh mesh = import(skinned_strip());
  ASSERT_EQ(mesh.bodies.bodies.size(), 2U);
  EXPECT_EQ(mesh.bodies.bodies[0].name, "bones");
  EXPECT_EQ(mesh.bodies.bodies[0].skin, 0);
  EXPECT_EQ(mesh.bodies.bodies[1].name, "prop") << "a prop on a bone, though no animation moves that";
  EXPECT_EQ(mesh.rig.nodes.at(static_cast<std::size_t>(mesh.bodies.bodies[1].places.at(0).node)).name, "prop");
  const Bounds bounds = bounds_of({mesh.positions.begin(), mesh.positions.begin() + 10});
  EXPECT_LT((bounds.low - Vec3f(-0.5F, 0, 0)).length(), 1e-6F) << "two metres high, upright, whatever the node says";
  EXPECT_LT((bounds.high - Vec3f(0.5F, 2, 0)).length(), 1e-6F);
  const AttributeStream* influences = find_stream(mesh.corner_attributes, kInfluences);
  ASSERT_NE(influences, nullptr);
  for (std::size_t c = 0; c < 3 * mesh.triangles.size(); ++c) {
    const bool is_skin = mesh.bodies.owner_of(mesh.materials[c / 3]) == 0;
    EXPECT_TRUE(is_influence(influences->at(c)));
    EXPECT_EQ(is_unmoved(influences->at(c)), !is_skin);
  }
}

TEST_F(MovingBodies, OfSkinsAreWeldedWhereTheyAreModelled) {
  // Another mesh of the same skin meets the strip's upper end, its joints in another order; a third follows another
  // joint there.
  TestGltf gltf = skinned_strip();
  const auto add = [&](const std::vector<std::uint8_t>& joint, const std::vector<float>& weight) {
    std::vector<std::uint8_t> joints;
    std::vector<float> weights;
    for (int v = 0; v < 3; ++v) {
      joints.insert(joints.end(), joint.begin(), joint.end());
      weights.insert(weights.end(), weight.begin(), weight.end());
    }
    gltf.add_simple_mesh({{-50, 0, 200}, {50, 0, 200}, {0, 0, 300}}, {0, 1, 2});
    json& attributes = gltf.document["meshes"].back()["primitives"][0]["attributes"];
    attributes["JOINTS_0"] = gltf.add_values(joints, "VEC4", kUnsignedByte);
    attributes["WEIGHTS_0"] = gltf.add_values(weights, "VEC4", kFloat);
    gltf.document["nodes"].back()["skin"] = 0;
  };
  add({1, 0, 0, 0}, {0.99F, 0.01F, 0, 0});
  EXPECT_EQ(import(gltf).positions.size(), 4U + 10U + 1U);
  add({0, 0, 0, 0}, {1, 0, 0, 0});
  EXPECT_EQ(import(gltf).positions.size(), 4U + 10U + 1U + 3U);
}

TEST_F(MovingBodies, TakeTheHeaviestOfAllJointsThatMoveAVertex) {
  TestGltf gltf = skinned_strip();
  json& attributes = gltf.document["meshes"][0]["primitives"][0]["attributes"];
  std::vector<std::uint16_t> joints;
  std::vector<std::uint8_t> weights;
  for (int v = 0; v < 10; ++v) {
    joints.insert(joints.end(), {1, 1, 0, 0});
    weights.insert(weights.end(), {128, 127, 0, 0});
  }
  attributes["JOINTS_1"] = gltf.add_values(joints, "VEC4", kUnsignedShort);
  attributes["WEIGHTS_1"] = gltf.add_values(weights, "VEC4", kUnsignedByte, true);
  const SourceMesh mesh = import(gltf);
  const float* influence = find_stream(mesh.corner_attributes, kInfluences)->at(0);
  const bool strip_first = mesh.bodies.owner_of(mesh.materials[0]) == 0;
  ASSERT_TRUE(strip_first);
  EXPECT_NEAR(influence[kMostJoints], 0.5, 1e-6) << "one of the first set, one of both entries of the second";
  EXPECT_NEAR(influence[kMostJoints + 1], 0.5, 1e-6);
  EXPECT_EQ(influence[0] + influence[1], 1);
}

TEST_F(MovingBodies, TakeAsManyJointsAsAreAskedFor) {
  // Seven joints, which weigh 1 to 7 of 28 each: two more below those of the strip, and the same ones again.
  TestGltf gltf = skinned_strip();
  const std::vector<float> bind{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  std::vector<float> binds;
  json joints_of_skin = json::array();
  for (int j = 0; j < 7; ++j) {
    gltf.add_node({{"name", "more"}});
    joints_of_skin.push_back(gltf.document["nodes"].size() - 1);
    binds.insert(binds.end(), bind.begin(), bind.end());
  }
  const int view = gltf.add_view(binds);
  gltf.document["skins"][0] = {
      {"joints", joints_of_skin},
      {"inverseBindMatrices",
       gltf.add_accessor({{"bufferView", view}, {"componentType", kFloat}, {"type", "MAT4"}, {"count", 7}})}};
  std::array<std::vector<std::uint8_t>, 2> joints;
  std::array<std::vector<float>, 2> weights;
  for (int v = 0; v < 10; ++v) {
    for (std::size_t i = 0; i < 8; ++i) {
      joints[i / 4].push_back(static_cast<std::uint8_t>(i % 7));
      weights[i / 4].push_back(i < 7 ? static_cast<float>(i + 1) / 28 : 0);
    }
  }
  json& attributes = gltf.document["meshes"][0]["primitives"][0]["attributes"];
  for (const std::size_t set : {0U, 1U}) {
    attributes["JOINTS_" + std::to_string(set)] = gltf.add_values(joints[set], "VEC4", kUnsignedByte);
    attributes["WEIGHTS_" + std::to_string(set)] = gltf.add_values(weights[set], "VEC4", kFloat);
  }
  write_bytes(folder_ / "asset.glb", gltf.glb());
  for (const int most : {4, 8}) {
    const SourceMesh mesh = import_asset(folder_ / "asset.glb", {.joints = most});
    const AttributeStream* influences = find_stream(mesh.corner_attributes, kInfluences);
    ASSERT_NE(influences, nullptr);
    const auto skinned = std::find_if(mesh.materials.begin(), mesh.materials.end(), [&](std::int32_t material) {
      const std::int32_t body = mesh.bodies.owner_of(material);
      return body >= 0 && mesh.bodies.bodies[body].skin >= 0;
    });
    const float* of_corner = influences->at(3 * static_cast<std::size_t>(skinned - mesh.materials.begin()));
    EXPECT_EQ(of_corner[0], 6) << "the heaviest first";
    EXPECT_EQ(std::count_if(of_corner + kMostJoints, of_corner + 2 * kMostJoints, [](float w) { return w > 0; }),
              std::min(most, 7));
    EXPECT_NEAR(of_corner[kMostJoints], most == 4 ? 7.0 / 22 : 7.0 / 28, 1e-6);
    EXPECT_EQ(sets_of_joints(influences->values), most / 4);
    write_source_mesh(folder_ / "once.glb", mesh);
    expect_same_mesh(mesh, read_source_mesh(folder_ / "once.glb"));
  }
}

TEST_F(MovingBodies, AreKeptByTheSurfacesOwnFile) {
  TestGltf gltf = skinned_strip();
  animate(gltf, 3, "rotation", {0, 0, 0, 1, 1, 0, 0, 0}, "STEP");
  const SourceMesh mesh = import(gltf);
  write_source_mesh(folder_ / "once.glb", mesh);
  for (const SourceMesh& again :
       {read_source_mesh(folder_ / "once.glb"), import_surface(folder_ / "once.glb", {.fill_holes = 0})}) {
    expect_same_mesh(mesh, again);
    fixtures::expect_same(mesh.bodies, again.bodies);
    fixtures::expect_same(mesh.rig, again.rig);
  }
}

TEST_F(MovingBodies, AreRefusedOrMendedWhereTheirSkinIsBroken) {
  const auto code_after = [&](const std::function<void(json&)>& change) {
    TestGltf gltf = skinned_strip();
    change(gltf.document);
    return code_of(gltf);
  };
  EXPECT_EQ(code_after([](json&) {}), ExitCode::kDone);
  EXPECT_EQ(code_after([](json& d) { d["skins"][0]["joints"] = {2, 77}; }), ExitCode::kUnusableInput);
  EXPECT_EQ(code_after([](json& d) { d["skins"][0]["joints"] = json::array(); }), ExitCode::kDone);
  EXPECT_EQ(code_after([](json& d) { d["skins"][0]["joints"] = {2}; }), ExitCode::kDone) << "a joint out of range";
  EXPECT_EQ(code_after([](json& d) {
              d["skins"][0]["joints"] = {2, 3, 1};
            }),
            ExitCode::kUnusableInput)
      << "more joints than matrices";
  EXPECT_EQ(code_after([](json& d) { d["skins"][0].erase("inverseBindMatrices"); }), ExitCode::kDone);
  EXPECT_EQ(code_after([](json& d) { d["skins"][0]["inverseBindMatrices"] = 0; }), ExitCode::kUnusableInput);
  EXPECT_EQ(code_after([](json& d) { d["skins"][0]["inverseBindMatrices"] = 99; }), ExitCode::kUnusableInput);
  EXPECT_EQ(code_after([](json& d) { d["skins"][0]["skeleton"] = 99; }), ExitCode::kDone);
  EXPECT_EQ(code_after([](json& d) { d["nodes"][3]["scale"] = {0, 0, 0}; }), ExitCode::kDone);
  EXPECT_EQ(code_after([](json& d) { d["meshes"][0]["primitives"][0]["attributes"]["JOINTS_0"] = 0; }),
            ExitCode::kUnusableInput);
  EXPECT_EQ(code_after([](json& d) { d["meshes"][0]["primitives"][0]["attributes"].erase("WEIGHTS_0"); }),
            ExitCode::kDone);
}

TEST_F(MovingBodies, LeaveOutAnimationsThatAreBrokenWithANote) {
  const auto animations_after = [&](const std::function<void(json&)>& change) {
    TestGltf gltf = skinned_strip();
    animate(gltf, 3, "translation", {0, 0, 100, 0, 0, 120});
    change(gltf.document);
    ImportReport report;
    const SourceMesh mesh = import(gltf, &report);
    EXPECT_EQ(report.notes.empty(), !mesh.rig.animations.empty());
    return mesh.rig.animations.size();
  };
  const auto sampler = [](json& d) -> json& { return d["animations"][0]["samplers"][0]; };
  const auto target = [](json& d) -> json& { return d["animations"][0]["channels"][0]["target"]; };
  EXPECT_EQ(animations_after([](json&) {}), 1U);
  EXPECT_EQ(animations_after([&](json& d) { sampler(d)["input"] = 99; }), 0U);
  EXPECT_EQ(animations_after([&](json& d) { sampler(d)["input"] = 0; }), 0U);
  EXPECT_EQ(animations_after([&](json& d) { sampler(d)["output"] = -1; }), 0U);
  EXPECT_EQ(animations_after([&](json& d) { sampler(d)["interpolation"] = "MAGIC"; }), 0U);
  EXPECT_EQ(animations_after([&](json& d) { sampler(d)["interpolation"] = "CUBICSPLINE"; }), 0U) << "too few keys";
  EXPECT_EQ(animations_after([&](json& d) { target(d)["path"] = "weights"; }), 0U);
  EXPECT_EQ(animations_after([&](json& d) { target(d)["path"] = "rotation"; }), 0U) << "three components";
  EXPECT_EQ(animations_after([&](json& d) { target(d)["node"] = 99; }), 0U);
  EXPECT_EQ(animations_after([&](json& d) { d["animations"][0]["channels"][0]["sampler"] = 7; }), 0U);
}

}  // namespace
}  // namespace lozenge
