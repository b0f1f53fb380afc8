#include "stages/export/quadric.h"

#include <gtest/gtest.h>

#include <random>

namespace lozenge {
namespace {

Vec3d random_vector(std::mt19937& random) {
  std::uniform_real_distribution<double> number(-1, 1);
  return {number(random), number(random), number(random)};
}

TEST(Quadric, IsTheSumOfSquaredDistances) {
  std::mt19937 random(1);
  Quadric sum;
  double expected = 0;
  const Vec3d x = random_vector(random);
  for (int i = 0; i < 20; ++i) {
    const Vec3d normal = random_vector(random).normalized();
    const Vec3d point = random_vector(random);
    const double weight = 0.1 + i;
    Quadric one;
    one.add_plane(normal, point, weight);
    one.add_point(point, 2);
    sum += one;
    expected += weight * std::pow(normal.dot(x - point), 2) + 2 * (x - point).length2();
  }
  EXPECT_NEAR(sum.at(x), expected, 1e-9 * expected);
}

TEST(Quadric, IsLeastWhereThreePlanesMeet) {
  std::mt19937 random(2);
  for (int i = 0; i < 100; ++i) {
    const Vec3d corner = random_vector(random);
    Quadric sum;
    for (int plane = 0; plane < 3; ++plane) sum.add_plane(random_vector(random).normalized(), corner, 1);
    sum.add_point(corner + random_vector(random), 1e-9);
    // Planes that happen to lie nearly along a line leave the corner nearly free.
    EXPECT_LT((sum.least() - corner).length(), 1e-3);
    EXPECT_LT(sum.at(sum.least()), 1e-7);
  }
}

}  // namespace
}  // namespace lozenge
