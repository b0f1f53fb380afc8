#include "formats/files/readers/polygon_cuts.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lozenge {
namespace {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

Triangles cuts_of(const std::vector<Vec3f>& corners) {
  Triangles triangles;
  cut_polygon(corners, triangles);
  return triangles;
}

/// Along z; negative where a triangle is turned over.
double area(const std::vector<Vec3f>& p, const std::array<std::uint32_t, 3>& t) {
  return 0.5 * (Vec3d(p[t[1]]) - Vec3d(p[t[0]])).cross(Vec3d(p[t[2]]) - Vec3d(p[t[0]])).z;
}

/// Every triangle faces up and together they have the polygon's area: so none overlaps another.
void expect_tiles(const std::vector<Vec3f>& polygon, double whole) {
  const Triangles triangles = cuts_of(polygon);
  EXPECT_EQ(triangles.size(), polygon.size() - 2);
  double sum = 0;
  for (const auto& t : triangles) {
    EXPECT_GT(area(polygon, t), 0);
    sum += area(polygon, t);
  }
  EXPECT_NEAR(sum, whole, 1e-9 * whole);
}

TEST(PolygonCuts, AConvexPolygonIsAFan) {
  EXPECT_EQ(cuts_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}), (Triangles{{0, 1, 2}}));
  EXPECT_EQ(cuts_of({{0, 0, 0}, {2, 0, 0}, {3, 1, 0}, {1, 3, 0}, {-1, 1, 0}}),
            (Triangles{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}}));
}

TEST(PolygonCuts, ANotchedPolygonIsTakenApartWithoutFolds) {
  expect_tiles({{0, 0, 0}, {2, 0, 0}, {0.5F, 0.5F, 0}, {0, 2, 0}}, 1.0);
  expect_tiles({{0.5F, 0.5F, 0}, {0, 2, 0}, {0, 0, 0}, {2, 0, 0}}, 1.0);
  // The letter E.
  expect_tiles({{0, 0, 0},
                {3, 0, 0},
                {3, 1, 0},
                {1, 1, 0},
                {1, 2, 0},
                {3, 2, 0},
                {3, 3, 0},
                {1, 3, 0},
                {1, 4, 0},
                {3, 4, 0},
                {3, 5, 0},
                {0, 5, 0}},
               11.0);
}

TEST(PolygonCuts, ACornerOnAStraightSideMakesNoFlatTriangle) {
  expect_tiles({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}}, 4.0);
}

TEST(PolygonCuts, StarsOfAnySizeAreTiledAsFarAsEarsAreLookedFor) {
  for (int n = 4; n <= 64; ++n) {
    std::vector<Vec3f> star;
    double whole = 0;
    for (int k = 0; k < 2 * n; ++k) {
      const double angle = std::acos(-1.0) * k / n;
      const double radius = k % 2 == 0 ? 1.0 : 0.3;
      star.emplace_back(static_cast<float>(radius * std::cos(angle)), static_cast<float>(radius * std::sin(angle)),
                        0.0F);
    }
    for (std::size_t k = 0; k < star.size(); ++k) {
      const Vec3f& a = star[k];
      const Vec3f& b = star[(k + 1) % star.size()];
      whole += 0.5 * (static_cast<double>(a.x) * static_cast<double>(b.y) -
                      static_cast<double>(a.y) * static_cast<double>(b.x));
    }
    expect_tiles(star, whole);
  }
}

TEST(PolygonCuts, WhatHasNoEarsGivesItsTrianglesAllTheSame) {
  EXPECT_EQ(cuts_of({{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}}).size(), 2U) << "crossed by itself";
  EXPECT_EQ(cuts_of(std::vector<Vec3f>(7, Vec3f(1, 2, 3))).size(), 5U) << "a point";
  EXPECT_EQ(cuts_of(std::vector<Vec3f>(5000, Vec3f(1, 2, 3))).size(), 4998U);
}

}  // namespace
}  // namespace lozenge
