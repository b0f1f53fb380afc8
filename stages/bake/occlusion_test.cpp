#include "stages/bake/occlusion.h"

#include <gtest/gtest.h>

namespace lozenge {
namespace {

/// Two triangles that make a square: from `corner` along two edges.
void add_square(const Vec3f& corner, const Vec3f& u, const Vec3f& v, std::vector<Vec3f>& positions,
                std::vector<std::array<VertexId, 3>>& triangles) {
  const auto first = static_cast<VertexId>(positions.size());
  for (const Vec3f& p : {corner, corner + u, corner + u + v, corner + v}) positions.push_back(p);
  triangles.push_back({first, first + 1, first + 2});
  triangles.push_back({first, first + 2, first + 3});
}

/// A floor of 200 x 200 at z = 0 and walls of 100 along x = 0 and y = 0, as many as wanted.
RayScene floor_with_walls(int walls) {
  std::vector<Vec3f> positions;
  std::vector<std::array<VertexId, 3>> triangles;
  add_square({-100, -100, 0}, {200, 0, 0}, {0, 200, 0}, positions, triangles);
  if (walls > 0) add_square({0, -100, 0}, {0, 200, 0}, {0, 0, 100}, positions, triangles);
  if (walls > 1) add_square({-100, 0, 0}, {200, 0, 0}, {0, 0, 100}, positions, triangles);
  return {positions, triangles};
}

TEST(Openness, IsWhatGeometrySaysInCorners) {
  // Close to the corner: the whole sky, half of it, a quarter of it.
  for (const int walls : {0, 1, 2}) {
    const RayScene scene = floor_with_walls(walls);
    const double expected = std::array{1.0, 0.5, 0.25}[walls];
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
      std::int64_t rays = 0;
      const OcclusionPoint point{{0.01, 0.01, 0}, {0, 0, 1}, {0, 0, 1}};
      EXPECT_NEAR(openness(scene, point, {256, 1e-3, 1e9}, seed, rays), expected, 0.05);
      EXPECT_EQ(rays, 256);
    }
  }
}

TEST(Openness, GrowsWithTheDistanceFromAWall) {
  const RayScene scene = floor_with_walls(1);
  double last = 0;
  for (const double x : {0.1, 30.0, 60.0, 90.0}) {
    std::int64_t rays = 0;
    const float open = openness(scene, {{x, 0, 0}, {0, 0, 1}, {0, 0, 1}}, {1024, 1e-3, 1e9}, 7, rays);
    EXPECT_GT(open, last);
    last = open;
  }
}

TEST(Openness, IgnoresWhatIsTooFarAway) {
  const RayScene scene = floor_with_walls(2);
  std::int64_t rays = 0;
  EXPECT_EQ(openness(scene, {{10, 10, 0}, {0, 0, 1}, {0, 0, 1}}, {256, 1e-3, 9.9}, 7, rays), 1);
  EXPECT_LT(openness(scene, {{10, 10, 0}, {0, 0, 1}, {0, 0, 1}}, {256, 1e-3, 50}, 7, rays), 0.9);
}

TEST(Openness, CountsNoRaysBelowTheFaceItself) {
  // The shading normal leans by 45 degrees, so some of its sky lies below the floor.
  const RayScene scene = floor_with_walls(0);
  std::int64_t rays = 0;
  const Vec3d leaning = Vec3d(1, 0, 1).normalized();
  EXPECT_EQ(openness(scene, {{0, 0, 0}, {0, 0, 1}, leaning}, {256, 1e-3, 1e9}, 3, rays), 1);
  EXPECT_LT(rays, 256);
  EXPECT_GT(rays, 128);
}

}  // namespace
}  // namespace lozenge
