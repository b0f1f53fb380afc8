#include "formats/surface/bodies.h"

#include <gtest/gtest.h>

#include <cmath>

#include "formats/base/error.h"
#include "formats/surface/body_fixtures.h"

namespace lozenge {
namespace {

TEST(Placement, MovesAsTheMatrixOfANodeDoes) {
  const Placement quarter{0, 2, 0, 0, -2, 0, 0, 0, 0, 0, 2, 0, 5, 6, 7, 1};  // around z, twice as large
  EXPECT_EQ(placed(quarter, {1, 0, 0}), Vec3f(5, 8, 7));
  EXPECT_EQ(placed(quarter, {0, 1, 3}), Vec3f(3, 6, 13));
  EXPECT_EQ(placed(kUnmoved, {1, 2, 3}), Vec3f(1, 2, 3));
}

TEST(Placement, IsATransformOfANodeWhereItTurnsScalesAndMoves) {
  std::mt19937 random(7);
  int mirroring = 0;
  for (int i = 0; i < 1000; ++i) {
    const Placement placement = fixtures::random_placement(random);
    EXPECT_TRUE(is_node_transform(placement));
    mirroring += is_mirroring(placement);
    const auto spoilt = [&](std::size_t at, double value) {
      Placement other = placement;
      other[at] = value;
      return is_node_transform(other);
    };
    EXPECT_FALSE(spoilt(random() % 16, NAN));
    EXPECT_FALSE(spoilt(random() % 16, INFINITY));
    EXPECT_FALSE(spoilt(3 + 4 * (random() % 3), 1e-9));
    EXPECT_FALSE(spoilt(15, 2));
    Placement sheared = placement;
    for (int c = 0; c < 3; ++c) sheared[c] += 1e-3 * sheared[4 + c];
    EXPECT_FALSE(is_node_transform(sheared));
    Placement flat = placement;
    for (int c = 0; c < 3; ++c) flat[c] = 0;
    EXPECT_FALSE(is_node_transform(flat));
  }
  EXPECT_GT(mirroring, 400);
  EXPECT_LT(mirroring, 600);
}

TEST(Placement, CanBeUndoneWhereItKeepsAnExtent) {
  std::mt19937 random(9);
  for (int i = 0; i < 1000; ++i) {
    Placement placement = fixtures::random_placement(random);
    EXPECT_TRUE(is_invertible(placement));
    const Imath::M44d there = matrix_of(placement);
    EXPECT_LT((placed(there.inverse(), placed(there, Vec3d(1, -2, 3))) - Vec3d(1, -2, 3)).length(), 1e-9);
    EXPECT_EQ(placement_of(there), placement);
    for (int c = 0; c < 3; ++c) placement[c] = placement[4 + c];  // two axes in one direction
    EXPECT_FALSE(is_invertible(placement));
  }
  EXPECT_FALSE(is_invertible({}));
}

TEST(Bodies, AreShownAsOneSurfaceWhereThatHasARightSize) {
  EXPECT_NO_THROW(require_sensible_copies(0, 1'000'000'000));
  EXPECT_NO_THROW(require_sensible_copies(2000, 100'000));
  EXPECT_THROW(require_sensible_copies(2001, 100'000), Error);
}

TEST(Bodies, AreCopiedFromWhereTheirSurfaceStands) {
  std::mt19937 random(10);
  for (int i = 0; i < 100; ++i) {
    const Placement first = fixtures::random_placement(random);
    const Placement second = fixtures::random_placement(random);
    const std::vector<Placement> copies = copies_of({"wheel", {{first, 3}, {second, 4}}, -1});
    ASSERT_EQ(copies.size(), 1U);
    const Vec3f p(0.5F, -1, 2);
    EXPECT_LT((placed(copies[0], placed(first, p)) - placed(second, p)).length(), 1e-3F * placed(second, p).length());
    EXPECT_EQ(copies_of({"stone", {{}, {second, -1}}, -1}), std::vector{second}) << "bit by bit";
  }
  EXPECT_TRUE(copies_of({"skin", {{}}, 0}).empty());
}

TEST(Bodies, AreSoundWhereOwnersAndPlacesExist) {
  std::mt19937 random(8);
  EXPECT_FALSE(find_defect(Bodies(), 5));
  for (int i = 0; i < 100; ++i) {
    const std::size_t count = 1 + random() % 9;
    const Bodies bodies = fixtures::random_moving_bodies(count, fixtures::random_rig(random), random);
    EXPECT_FALSE(find_defect(bodies, count));
    EXPECT_TRUE(find_defect(bodies, count + 1));
    const auto spoilt = [&](const auto& change) {
      Bodies other = bodies;
      change(other);
      return find_defect(other, count).has_value();
    };
    EXPECT_TRUE(spoilt([&](Bodies& b) { b.owner[random() % count] = -2; }));
    EXPECT_TRUE(spoilt([&](Bodies& b) { b.owner[random() % count] = static_cast<std::int32_t>(b.bodies.size()); }));
    EXPECT_TRUE(spoilt([&](Bodies& b) { b.bodies.clear(); })) << "owners without bodies";
    EXPECT_TRUE(spoilt([&](Bodies& b) { b.bodies[random() % b.bodies.size()].places.clear(); }));
    EXPECT_TRUE(spoilt([&](Bodies& b) { b.bodies.back().places.back().placement[15] = 0; }));
    EXPECT_TRUE(spoilt([&](Bodies& b) { b.bodies.back().places.back().node = -2; }));
    EXPECT_TRUE(spoilt([&](Bodies& b) { b.bodies.back().skin = -2; }));
    EXPECT_TRUE(spoilt([&](Bodies& b) { b.bodies.front() = {"", {{}, {}}, 0}; })) << "a skin in two places";
  }
}

}  // namespace
}  // namespace lozenge
