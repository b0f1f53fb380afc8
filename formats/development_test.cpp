#include "formats/development.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "formats/distortion.h"
#include "formats/open_fixtures.h"
#include "formats/parameterization.h"
#include "formats/sphere_fixtures.h"

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
