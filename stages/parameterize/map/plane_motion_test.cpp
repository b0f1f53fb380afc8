#include "stages/parameterize/map/plane_motion.h"

#include <gtest/gtest.h>

#include <random>

namespace lozenge {
namespace {

UnitMotion random_motion(std::mt19937& random) {
  const auto step = [&] { return static_cast<std::int16_t>(static_cast<int>(random() % 41) - 20); };
  return {static_cast<std::int16_t>(random() % 6), {step(), step()}};
}

Vec2d random_point(std::mt19937& random) {
  std::uniform_real_distribution<double> coordinate(-3, 3);
  return {coordinate(random), coordinate(random)};
}

TEST(UnitMotion, ComposesAndInvertsAsAGroupExactlyAndOnPoints) {
  std::mt19937 random(1);
  for (int i = 0; i < 500; ++i) {
    const UnitMotion a = random_motion(random), b = random_motion(random), c = random_motion(random);
    EXPECT_EQ(composed(a, composed(b, c)), composed(composed(a, b), c));
    EXPECT_EQ(composed(a, inverse(a)), UnitMotion{});
    EXPECT_EQ(composed(inverse(a), a), UnitMotion{});
    const Vec2d p = random_point(random);
    EXPECT_LT((composed(a, b)(p) - a(b(p))).length(), 1e-12);
    EXPECT_LT((inverse(a)(a(p)) - p).length(), 1e-12);
  }
}

TEST(UnitMotion, IsFoundFromWhatItDoesToASegment) {
  std::mt19937 random(2);
  for (int i = 0; i < 500; ++i) {
    const UnitMotion m = random_motion(random);
    const Vec2d p = random_point(random), q = random_point(random);
    EXPECT_EQ(motion_of_segment(p, q, m(p), m(q)), m);
  }
}

TEST(UnitTransition, TakesASideOntoTheNeighboursSideTheOtherWayAround) {
  for (int from = 0; from < 3; ++from) {
    for (int to = 0; to < 3; ++to) {
      const UnitMotion& across = unit_transition(from, to);
      EXPECT_EQ(across(corner_step(to)), corner_step((from + 1) % 3));
      EXPECT_EQ(across(corner_step((to + 1) % 3)), corner_step(from));
      EXPECT_EQ(inverse(across), unit_transition(to, from));
    }
  }
}

TEST(CornerFrame, HasItsOriginInTheCornerAndItsAxisAlongTheSide) {
  for (int corner = 0; corner < 3; ++corner) {
    EXPECT_EQ(to_corner_frame(corner)(corner_step(corner)), UnitPoint{});
    EXPECT_EQ(to_corner_frame(corner)(corner_step((corner + 1) % 3)), (UnitPoint{1, 0}));
    EXPECT_EQ(composed(from_corner_frame(corner), to_corner_frame(corner)), UnitMotion{});
  }
}

}  // namespace
}  // namespace lozenge
