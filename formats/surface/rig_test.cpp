#include "formats/surface/rig.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "formats/surface/body_fixtures.h"

namespace lozenge {
namespace {

using Imath::M44d;

/// A chain of three joints, each one unit along x from the one above it; bound where it stands.
Rig chain() {
  Rig rig;
  RigSkin skin{"chain", {}, {}, -1};
  for (std::int32_t n = 0; n < 3; ++n) {
    rig.nodes.push_back({"", n - 1, {}, {1, 0, 0}, {}, {}});
    skin.joints.push_back(n);
    skin.inverse_binds.push_back(placement_of(rest_transforms(rig).back().inverse()));
  }
  rig.skins.push_back(skin);
  return rig;
}

TEST(Rig, PutsNodesWhereThoseAboveThemAre) {
  Rig rig = chain();
  EXPECT_EQ(placed(rest_transforms(rig)[2], Vec3d(0, 0, 0)), Vec3d(3, 0, 0));
  rig.nodes[0].rotation = {0, 0, std::sqrt(0.5), std::sqrt(0.5)};  // a quarter around z
  rig.nodes[1].scale = {2, 2, 2};
  EXPECT_LT((placed(rest_transforms(rig)[2], Vec3d(0, 0, 0)) - Vec3d(1, 3, 0)).length(), 1e-12);
}

TEST(Rig, LeavesTheSkinWhereItWasBoundInTheSamePose) {
  const Rig rig = chain();
  for (const M44d& joint : standing_joints(rig, 0, standing_transforms(rig))) {
    EXPECT_TRUE(joint.equalWithAbsError(M44d(), 1e-12));
  }
}

TEST(Rig, ShowsWhatIsHiddenAtRestByAScaleOfZero) {
  Rig rig = chain();
  rig.nodes[1].scale = {0, 0, 0};
  EXPECT_EQ(rest_transforms(rig)[2].determinant(), 0);
  EXPECT_TRUE(standing_transforms(rig)[2].equalWithAbsError(rest_transforms(chain())[2], 1e-12));
  rig.nodes[1].scale = {3, 0, 3};  // flat
  EXPECT_NEAR(standing_transforms(rig)[1].determinant(), 27, 1e-12);
}

TEST(Rig, LetsAJointWithoutExtentFollowTheOneAboveIt) {
  Rig rig = chain();
  rig.skins[0].inverse_binds[2] = {};
  rig.skins[0].inverse_binds[2][15] = 1;
  rig.nodes[1].translation = {1, 1, 0};
  const std::vector<M44d> joints = standing_joints(rig, 0, standing_transforms(rig));
  EXPECT_EQ(joints[2], joints[1]);
  EXPECT_NE(joints[2], joints[0]);
  for (Placement& bind : rig.skins[0].inverse_binds) bind = rig.skins[0].inverse_binds[2];
  for (const M44d& joint : standing_joints(rig, 0, standing_transforms(rig)))
    EXPECT_EQ(joint, M44d()) << "none is left";
}

TEST(Rig, BlendsJointsByTheirWeightsWhateverJointsThereAre) {
  const std::vector<M44d> joints{M44d(), M44d().translate(Imath::V3d(4, 0, 0))};
  using Influence = std::array<float, kInfluences.components>;
  const Influence half{0, 1, 0, 0, 0, 0, 0, 0, 0.5F, 0.5F};
  EXPECT_EQ(placed(blended(joints, half.data()), Vec3d(0, 1, 0)), Vec3d(2, 1, 0));
  const Influence other{1, 7, NAN, -1, 0, 0, 0, 0, 0.25F, 0.25F, 0.25F, 0.25F};
  EXPECT_EQ(placed(blended(joints, other.data()), Vec3d(0, 1, 0)), Vec3d(4, 1, 0)) << "the one that is there";
  const Influence none{};
  EXPECT_EQ(blended(joints, none.data()), M44d());
}

TEST(Rig, IsSoundWhereAllThatItNamesExists) {
  std::mt19937 random(3);
  for (int i = 0; i < 50; ++i) {
    const Rig rig = fixtures::random_rig(random);
    EXPECT_FALSE(find_defect(rig));
    const auto spoilt = [&](const auto& change) {
      Rig other = rig;
      change(other);
      return find_defect(other).has_value();
    };
    EXPECT_TRUE(spoilt([](Rig& r) { r.nodes[1].parent = 1; }));
    EXPECT_TRUE(spoilt([](Rig& r) { r.nodes[0].translation = {1, 2}; }));
    EXPECT_TRUE(spoilt([](Rig& r) { r.nodes[0].scale = {1, NAN, 1}; }));
    EXPECT_TRUE(spoilt([](Rig& r) { r.nodes[0].rotation = {0, 0, 0, 0}; }));
    EXPECT_TRUE(spoilt([](Rig& r) { r.skins[0].joints[0] = 4; }));
    EXPECT_TRUE(spoilt([](Rig& r) { r.skins[0].inverse_binds.pop_back(); }));
    EXPECT_TRUE(spoilt([](Rig& r) { r.skins[0] = {}; }));
    EXPECT_TRUE(spoilt([](Rig& r) { r.animations[0].channels[0].node = -1; }));
    EXPECT_TRUE(spoilt([](Rig& r) { r.animations[0].channels[0].sampler = 1; }));
    EXPECT_TRUE(spoilt([](Rig& r) { r.animations[0].channels[0].path = ChannelPath::kScale; }));
    EXPECT_TRUE(spoilt([](Rig& r) { r.animations[0].samplers[0].values.pop_back(); }));
  }
}

}  // namespace
}  // namespace lozenge
