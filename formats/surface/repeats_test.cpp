#include "formats/surface/repeats.h"

#include <gtest/gtest.h>

#include <cmath>

#include "formats/base/error.h"
#include "formats/surface/repeat_fixtures.h"

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

TEST(Repeats, AreShownAsOneSurfaceWhereThatHasARightSize) {
  EXPECT_NO_THROW(require_sensible_copies(0, 1'000'000'000));
  EXPECT_NO_THROW(require_sensible_copies(2000, 100'000));
  EXPECT_THROW(require_sensible_copies(2001, 100'000), Error);
}

TEST(Repeats, AreSoundWhereOwnersAndCopiesExist) {
  std::mt19937 random(8);
  EXPECT_FALSE(find_defect(Repeats(), 5));
  for (int i = 0; i < 100; ++i) {
    const std::size_t count = 1 + random() % 9;
    const Repeats repeats = fixtures::random_repeats(count, random);
    EXPECT_FALSE(find_defect(repeats, count));
    EXPECT_TRUE(find_defect(repeats, count + 1));
    const auto spoilt = [&](const auto& change) {
      Repeats other = repeats;
      change(other);
      return find_defect(other, count).has_value();
    };
    EXPECT_TRUE(spoilt([&](Repeats& r) { r.owner[random() % count] = -2; }));
    EXPECT_TRUE(spoilt([&](Repeats& r) { r.owner[random() % count] = static_cast<std::int32_t>(r.meshes.size()); }));
    EXPECT_TRUE(spoilt([&](Repeats& r) { r.meshes.clear(); })) << "owners without meshes";
    EXPECT_TRUE(spoilt([&](Repeats& r) { r.meshes[random() % r.meshes.size()].copies.clear(); }));
    EXPECT_TRUE(spoilt([&](Repeats& r) { r.meshes.back().copies.back()[15] = 0; }));
  }
}

}  // namespace
}  // namespace lozenge
