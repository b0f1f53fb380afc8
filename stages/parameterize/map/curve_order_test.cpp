#include "stages/parameterize/map/curve_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "formats/surface/canonical_form.h"
#include "stages/parameterize/surface_fixtures.h"

namespace lozenge {
namespace {

/// The mean distance in memory between the corners of a triangle.
double mean_spread(const SourceMesh& mesh) {
  double sum = 0;
  for (const auto& [a, b, c] : mesh.triangles) sum += std::max({a, b, c}) - std::min({a, b, c});
  return sum / static_cast<double>(mesh.triangles.size());
}

TEST(CurveOrder, InterleavesBits) {
  EXPECT_EQ(interleaved<3>({1, 0, 0}), 4U);
  EXPECT_EQ(interleaved<3>({0, 1, 0}), 2U);
  EXPECT_EQ(interleaved<3>({0, 0, 3}), 9U);
  EXPECT_EQ(interleaved<2>({0xFFFF, 0}), 0xAAAAAAAAU);
}

TEST(CurveOrder, NamesEveryTriangleOnceAndBringsNearOnesTogether) {
  SourceMesh mesh = test::sphere(40, test::random_relief(0.2, 1));
  std::vector<TriangleId> shuffled(mesh.triangles.size());
  std::iota(shuffled.begin(), shuffled.end(), 0);
  std::shuffle(shuffled.begin(), shuffled.end(), std::mt19937(1));
  make_canonical(mesh, shuffled);
  const double before = mean_spread(mesh);
  std::vector<TriangleId> order = triangles_along_curve(mesh);
  make_canonical(mesh, order);
  EXPECT_LT(mean_spread(mesh), before / 10);
  std::sort(order.begin(), order.end());
  for (std::size_t t = 0; t < order.size(); ++t) ASSERT_EQ(order[t], static_cast<TriangleId>(t));
}

TEST(CurveOrder, TakesPointsOfABoxWithoutSize) {
  SourceMesh mesh;
  mesh.positions.assign(3, Vec3f(1, 2, 3));
  mesh.triangles = {{0, 1, 2}, {0, 1, 2}};
  EXPECT_EQ(triangles_along_curve(mesh), (std::vector<TriangleId>{0, 1}));
}

}  // namespace
}  // namespace lozenge
