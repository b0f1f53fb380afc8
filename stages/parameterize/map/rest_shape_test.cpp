#include "stages/parameterize/map/rest_shape.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace lozenge {
namespace {

/// A triangle on a base of this length, far from the axes.
std::vector<Vec3f> triangle(double base, double foot, double height) {
  const Vec3d along = Vec3d(2, 1, -2) / 3, up = Vec3d(1, 2, 2) / 3;
  return {Vec3f(0, 0, 0), Vec3f(along * base), Vec3f(along * foot + up * height)};
}

struct Measured {
  double t = 0;
  double d = 0;
};

Measured measure(const RestShape& rest, const std::array<Vec2d, 3>& image) {
  Measured m;
  for (int i = 0; i < 3; ++i) m.t += rest.weight[i] * (image[(i + 2) % 3] - image[(i + 1) % 3]).length2();
  m.d = (image[1] - image[0]).cross(image[2] - image[0]) * rest.inverse_area;
  return m;
}

TEST(RestShape, IsAnIsometryForATriangleOfTheSameShape) {
  const RestShape rest = rest_shape(triangle(2, 0.7, 0.4), {0, 1, 2}, 10, 1e-3);
  const Measured m = measure(rest, {Vec2d(0, 0), Vec2d(2, 0), Vec2d(0.7, 0.4)});
  EXPECT_NEAR(m.t, 2, 1e-5);
  EXPECT_NEAR(m.d, 1, 1e-6);
  EXPECT_NEAR(rest.share, 0.4 / 10, 1e-7);
}

TEST(RestShape, IsTheSameFromEveryCorner) {
  const std::vector<Vec3f> points = triangle(2, 0.7, 1e-4);
  const RestShape a = rest_shape(points, {0, 1, 2}, 10, 1e-2);
  const RestShape b = rest_shape(points, {1, 2, 0}, 10, 1e-2);
  for (int i = 0; i < 3; ++i) EXPECT_FLOAT_EQ(a.weight[(i + 1) % 3], b.weight[i]);
  EXPECT_FLOAT_EQ(a.inverse_area, b.inverse_area);
}

TEST(RestShape, RaisesWhatIsTooFlatAndKeepsItsShare) {
  const RestShape rest = rest_shape(triangle(2, 0.7, 1e-5), {0, 1, 2}, 10, 1e-2);
  const Measured m = measure(rest, {Vec2d(0, 0), Vec2d(2, 0), Vec2d(0.7, 0.02)});
  EXPECT_NEAR(m.t, 2, 1e-2);
  EXPECT_NEAR(m.d, 1, 1e-5);
  EXPECT_NEAR(rest.share, 1e-5 / 10, 1e-9);
}

// 2 d <= T holds for every linear map; single precision must not break it, for the energy would turn negative.
TEST(RestShape, NeverMeasuresLessThanAConformalMap) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> number(0, 1);
  for (int i = 0; i < 20'000; ++i) {
    const double base = std::pow(10.0, -4 * number(random));
    const double height = base * std::pow(10.0, -9 * number(random));
    const RestShape rest = rest_shape(triangle(base, base * number(random), height), {0, 1, 2}, 1, kFlattest);
    const double size = base * std::pow(10.0, 2 * number(random) - 1);
    const std::array<Vec2d, 3> image{Vec2d(0, 0), Vec2d(size, 0),
                                     Vec2d(size * number(random), size * std::pow(10.0, -4 * number(random)))};
    const Measured m = measure(rest, image);
    ASSERT_GT(m.d, 0);
    ASSERT_GT(m.t, 2 * m.d * 0.8) << "height by base " << height / base;
  }
}

TEST(RestShape, HoldsATriangleThatIsAPoint) {
  const RestShape rest = rest_shape({Vec3f(1, 1, 1), Vec3f(1, 1, 1), Vec3f(1, 1, 1)}, {0, 1, 2}, 10, 1e-3);
  for (const float w : rest.weight) EXPECT_TRUE(std::isfinite(w));
  EXPECT_TRUE(std::isfinite(rest.inverse_area));
  EXPECT_GT(rest.share, 0);
}

/// Triangles of one length, so many of each height, side by side but not joined.
double flattest_of(const std::vector<std::pair<int, double>>& heights) {
  std::vector<Vec3f> positions;
  std::vector<std::array<std::int32_t, 3>> triangles;
  for (const auto& [count, height] : heights) {
    for (int i = 0; i < count; ++i) {
      const auto first = static_cast<std::int32_t>(positions.size());
      for (const Vec3f& p : triangle(1, 0.3, height)) positions.push_back(p);
      triangles.push_back({first, first + 1, first + 2});
    }
  }
  return flattest_to_keep(positions, triangles);
}

TEST(FlattestToKeep, ChangesHardlyAnyOfTheSurface) {
  EXPECT_EQ(flattest_of({{100, 0.8}}), 1e-2);
  EXPECT_EQ(flattest_of({{100, 0.8}, {50, 5e-3}}), 1e-2);
  EXPECT_EQ(flattest_of({{100, 0.8}, {1000, 5e-3}}), 3e-3);
  EXPECT_EQ(flattest_of({{100, 2e-3}}), kFlattest);
  EXPECT_EQ(flattest_of({{100, 1e-5}}), kFlattest);
}

}  // namespace
}  // namespace lozenge
