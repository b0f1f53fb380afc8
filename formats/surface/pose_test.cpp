// Keys of animations at any time, and what they move.
#include "formats/surface/pose.h"

#include <gtest/gtest.h>

#include <cmath>

#include "formats/base/error.h"
#include "formats/surface/attribute_streams.h"

namespace lozenge {
namespace {

/// A node that one channel moves.
Rig one_channel(ChannelPath path, KeyInterpolation interpolation, int components, const std::vector<float>& values) {
  Rig rig;
  rig.nodes.push_back({"node", -1, {}, {}, {}, {}});
  rig.animations.push_back({"move", {{interpolation, components, {1, 3}, values}}, {{0, 0, path}}});
  return rig;
}

double first_of_translation(const Rig& rig, double time) {
  return posed(rig, {0, time}, "asset").rig.nodes[0].translation.at(0);
}

TEST(Poses, AreBetweenKeysAsTheInterpolationSays) {
  const Rig linear = one_channel(ChannelPath::kTranslation, KeyInterpolation::kLinear, 3, {2, 0, 0, 6, 0, 0});
  EXPECT_EQ(first_of_translation(linear, 0), 2) << "before the first key";
  EXPECT_EQ(first_of_translation(linear, 1), 2);
  EXPECT_EQ(first_of_translation(linear, 1.5), 3);
  EXPECT_EQ(first_of_translation(linear, 9), 6) << "after the last one";
  const Rig step = one_channel(ChannelPath::kTranslation, KeyInterpolation::kStep, 3, {2, 0, 0, 6, 0, 0});
  EXPECT_EQ(first_of_translation(step, 2.99), 2);
  EXPECT_EQ(first_of_translation(step, 3), 6);
  // Leaves with 1 a second and arrives with 1 a second; at half of the way Hermite's weights are 1/2 and +-1/8.
  const Rig spline = one_channel(ChannelPath::kTranslation, KeyInterpolation::kCubicSpline, 3,
                                 {9, 0, 0, 2, 0, 0, 1, 0, 0, 1, 0, 0, 6, 0, 0, 9, 0, 0});
  EXPECT_EQ(first_of_translation(spline, 2), 0.5 * 2 + 0.5 * 6 + 2 * (0.125 * 1 - 0.125 * 1));
  EXPECT_EQ(first_of_translation(spline, 3), 6);
}

TEST(Poses, TurnTheShorterWayRound) {
  const float h = std::sqrt(0.5F);
  // A quarter turn, written as that and as its negative.
  for (const float sign : {1.0F, -1.0F}) {
    const Rig rig =
        one_channel(ChannelPath::kRotation, KeyInterpolation::kLinear, 4, {0, 0, 0, 1, sign * h, 0, 0, sign * h});
    const std::vector<double> half = posed(rig, {0, 2}, "asset").rig.nodes[0].rotation;
    EXPECT_NEAR(std::abs(half[0]), std::sin(std::acos(-1.0) / 8), 1e-6);
    EXPECT_GT(half[0] * half[3], 0);
  }
}

TEST(Poses, AreRefusedOfAnimationsThatAreNotThere) {
  const Rig rig = one_channel(ChannelPath::kTranslation, KeyInterpolation::kLinear, 3, {2, 0, 0, 6, 0, 0});
  EXPECT_THROW(posed(rig, {1, 0}, "asset"), Error);
  EXPECT_THROW(posed(rig, {-1, 0}, "asset"), Error);
  EXPECT_THROW(posed(Rig(), {0, 0}, "asset"), Error);
}

TEST(Poses, AreSpreadOverAnimationsAndTheirTimes) {
  Rig rig = one_channel(ChannelPath::kTranslation, KeyInterpolation::kLinear, 3, {2, 0, 0, 6, 0, 0});
  for (int a = 0; a < 9; ++a) rig.animations.push_back(rig.animations.front());
  const std::vector<Pose> poses = sample_poses(rig, 2, 3);
  ASSERT_EQ(poses.size(), 6U);
  EXPECT_EQ(poses[0].animation, 0);
  EXPECT_EQ(poses[5].animation, 5);
  EXPECT_EQ(poses[1].time, 2);
  EXPECT_TRUE(sample_poses(Rig(), 2, 3).empty());
}

TEST(Poses, MoveASurfaceWithItsNodeAndItsWeights) {
  SourceMesh mesh;
  mesh.positions = {{1, 0, 0}, {2, 0, 0}, {1, 1, 0}, {5, 5, 5}};
  mesh.triangles = {{0, 1, 2}, {3, 3, 3}};
  mesh.materials = {1, 0};
  mesh.material_names = {"still", "moves"};
  mesh.rig = one_channel(ChannelPath::kTranslation, KeyInterpolation::kLinear, 3, {1, 0, 0, 1, 0, 4});
  mesh.rig.nodes[0].translation = {1, 0, 0};
  mesh.rig.animations[0].samplers.push_back({KeyInterpolation::kLinear, 1, {1, 3}, {0, 1}});
  mesh.rig.animations[0].channels.push_back({1, 0, ChannelPath::kWeights});
  const Placement at_node{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 1, 0, 0, 1};
  mesh.bodies = {{{"moves", {{at_node, 0}}, -1, {{"up", 0}}}}, {-1, 0}};
  AttributeStream& offsets = stream_for(mesh.corner_attributes, kMorphOffsets, 0);
  for (int c = 0; c < 6; ++c) offsets.values.insert(offsets.values.end(), {0, static_cast<float>(c), 0});
  const SourceMesh moved = in_pose(mesh, {0, 2});
  EXPECT_EQ(moved.positions, (std::vector<Vec3f>{{1, 0, 2}, {2, 0.5F, 2}, {1, 2, 2}, {5, 5, 5}}));
  EXPECT_EQ(moved.bodies.bodies[0].places[0].placement[14], 2);
}

}  // namespace
}  // namespace lozenge
