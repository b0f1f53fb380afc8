#include "formats/domain/development.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "formats/domain/distortion.h"
#include "formats/domain/open_fixtures.h"
#include "formats/domain/parameterization.h"
#include "formats/domain/sphere_fixtures.h"

namespace lozenge {
namespace {

TEST(Develop, LaysEveryTriangleOfASubdividedDomainFlatAndTheImagesTileIt) {
  for (const auto& base : {fixtures::tetrahedron(), fixtures::octahedron(), fixtures::icosahedron()}) {
    for (const int n : {1, 2, 3, 8}) {
      const auto [mesh, map] = fixtures::subdivided_sphere(base, n);
      const Distortion d = measure_distortion(mesh, map);
      EXPECT_EQ(d.folded_triangles, 0);
      EXPECT_EQ(d.area_sum_error, 0) << base.triangles.size() << " faces, " << n;
      EXPECT_GE(d.l2_stretch, 1 - 1e-9);
    }
  }
}

TEST(Develop, StillTilesAfterInteriorVerticesMove) {
  for (const auto& base : {fixtures::tetrahedron(), fixtures::octahedron(), fixtures::icosahedron()}) {
    for (unsigned seed = 0; seed < 20; ++seed) {
      auto [mesh, map] = fixtures::subdivided_sphere(base, 8);
      fixtures::jitter(map, 0.3 / 8, seed);
      const Distortion d = measure_distortion(mesh, map);
      EXPECT_EQ(d.folded_triangles, 0);
      EXPECT_EQ(d.area_sum_error, 0);
    }
  }
}

TEST(Develop, TilesDomainsWithABoundaryWhoseFansHaveAnyNumberOfTriangles) {
  for (const fixtures::OpenSurface& open : fixtures::open_surfaces()) {
    const Distortion d = measure_distortion(open.mesh, open.map);
    EXPECT_EQ(d.folded_triangles, 0) << open.name;
    EXPECT_EQ(d.area_sum_error, 0) << open.name;
    EXPECT_EQ(euler_characteristic(open.map.domain), open.euler) << open.name;
  }
}

TEST(Develop, LaysNoTriangleAcrossTheOutsideOfABoundaryFan) {
  // From the first triangle to the fourth around a vertex of the boundary: there is 120 degrees or less of outside
  // between them, but a half turn or more of inside.
  for (const int triangles : {4, 5, 7}) {
    const Domain fan = fixtures::fan(triangles, 1).map.domain;
    const DomainTriangleId last = fan.size() - 1;
    EXPECT_FALSE(develop(fan, {make_point(0, 0.5, 0.4), make_point(last, 0.5, 0.1), make_point(0, 0.7, 0.2)}))
        << triangles;
  }
}

/// Whether no side of either triangle has the two on its two sides: only then have they area in common.
bool has_area_in_common(const std::array<LatticePoint, 3>& a, const std::array<LatticePoint, 3>& b) {
  const auto parts = [](const std::array<LatticePoint, 3>& triangle, const std::array<LatticePoint, 3>& other) {
    for (int s = 0; s < 3; ++s) {
      const auto is_outside = [&](LatticePoint p) { return doubled_area(triangle[s], triangle[(s + 1) % 3], p) <= 0; };
      if (std::all_of(other.begin(), other.end(), is_outside)) return true;
    }
    return false;
  };
  return !parts(a, b) && !parts(b, a);
}

/// Two vertices of n triangles each.
Domain bipyramid(VertexId n) {
  std::vector<std::array<VertexId, 3>> triangles;
  for (VertexId i = 0; i < n; ++i) {
    triangles.push_back({n, i, (i + 1) % n});
    triangles.push_back({n + 1, (i + 1) % n, i});
  }
  return make_domain(triangles, n + 2);
}

TEST(Develop, LaysImagesOutFromATriangleThatTheyHaveAreaInCommonWith) {
  // Corners, points on sides and points inside: of the triangles around a point, some touch an image there alone.
  std::vector<DomainPoint> places;
  const auto add_places = [&](DomainTriangleId t) {
    for (int i = 0; i <= 4; ++i) {
      for (int j = 0; i + j <= 4; ++j) places.push_back(make_point(t, i / 4.0, j / 4.0));
    }
  };
  std::mt19937 random(1);
  int stars = 0;
  for (const Domain& domain : {fixtures::tetrahedron(), fixtures::octahedron(), fixtures::icosahedron(), bipyramid(10),
                               fixtures::fan(4, 1).map.domain, fixtures::fan(7, 1).map.domain}) {
    places.clear();
    for (DomainTriangleId t = 0; t < domain.size(); ++t) add_places(t);
    const auto any = [&] { return places[random() % places.size()]; };
    for (int i = 0; i < 20'000; ++i) {
      const std::array points{any(), any(), any()};
      const auto image = develop(domain, points);
      if (!image || doubled_area(image->corners[0], image->corners[1], image->corners[2]) <= 0) continue;
      EXPECT_TRUE(has_area_in_common(image->corners, {{{0, 0}, {kLatticeOne, 0}, {0, kLatticeOne}}}));
      for (int c = 0; c < 3; ++c) {
        const LatticePoint at = image->corners[c];
        const bool is_inside = at.u > 0 && at.v > 0 && at.u + at.v < kLatticeOne;
        EXPECT_TRUE(!is_inside || points[c].triangle == image->home);
      }
      stars += image->span == Span::kStar;
    }
  }
  EXPECT_GT(stars, 1000);
}

TEST(Develop, FindsNoImageForPointsThatShareNoStar) {
  const auto base = fixtures::icosahedron();
  const Domain& d = base;
  // Two triangles of an icosahedron that share no vertex.
  int far = -1;
  for (int t = 1; t < d.size() && far < 0; ++t) {
    bool shares = false;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) shares |= d.corner(0, i) == d.corner(t, j);
    if (!shares) far = t;
  }
  ASSERT_GE(far, 0);
  EXPECT_FALSE(develop(d, {make_point(0, .3, .3), make_point(0, .4, .3), make_point(far, .3, .3)}));
}

}  // namespace
}  // namespace lozenge
