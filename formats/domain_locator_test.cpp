#include "formats/domain_locator.h"

#include <gtest/gtest.h>

#include <random>

#include "formats/error.h"
#include "formats/sphere_fixtures.h"

namespace lozenge {
namespace {

struct Case {
  SourceMesh mesh;
  Parameterization map;
};

/// The icosahedron's and the octahedron's spheres, and the tetrahedron's (whose vertices join three triangles), with
/// even and with jittered maps.
std::vector<Case> cases() {
  std::vector<Case> result;
  for (const Domain& base : {fixtures::tetrahedron(), fixtures::octahedron(), fixtures::icosahedron()}) {
    for (const double distance : {0.0, 0.02}) {
      auto [mesh, map] = fixtures::subdivided_sphere(base, 12);
      fixtures::jitter(map, distance, 7);
      result.push_back({std::move(mesh), std::move(map)});
    }
  }
  return result;
}

DomainPoint random_point(const Domain& domain, std::mt19937& random) {
  std::uniform_real_distribution<double> number(0, 1);
  const auto t = static_cast<DomainTriangleId>(number(random) * domain.size());
  const double alpha = number(random);
  return make_point(t, alpha, number(random) * (1 - alpha));
}

TEST(DomainLocator, FindsTheTriangleWhoseImageHoldsThePosition) {
  for (const Case& c : cases()) {
    const DomainLocator locator(c.mesh, c.map);
    std::mt19937 random(3);
    for (int i = 0; i < 5000; ++i) {
      const DomainPoint p = random_point(c.map.domain, random);
      const SurfacePoint found = locator.locate(p);
      ASSERT_TRUE(found.exists());
      // The fixtures' images lie within one domain triangle, so weights of phi give the position back.
      double alpha = 0;
      double beta = 0;
      for (int k = 0; k < 3; ++k) {
        const auto image = image_of(c.mesh, c.map, found.triangle);
        ASSERT_EQ(image->home, p.triangle);
        const DomainPoint corner = domain_point(p.triangle, image->corners[k]);
        alpha += corner.alpha * found.weights[k];
        beta += corner.beta * found.weights[k];
      }
      EXPECT_NEAR(alpha, p.alpha, 1e-10);
      EXPECT_NEAR(beta, p.beta, 1e-10);
    }
  }
}

TEST(DomainLocator, GivesEveryVertexBack) {
  for (const Case& c : cases()) {
    const DomainLocator locator(c.mesh, c.map);
    for (std::size_t v = 0; v < c.map.phi.size(); ++v) {
      const SurfacePoint found = locator.locate(c.map.phi[v]);
      ASSERT_TRUE(found.exists());
      EXPECT_EQ(position_at(c.mesh, found), Vec3d(c.mesh.positions[v]));
    }
  }
}

/// A map whose triangles lie across the domain's sides: vertices on sides are moved off them, into one of the two
/// triangles there. Those next to a domain vertex then span its star.
Parameterization crossing_sides(const Parameterization& map, unsigned seed) {
  Parameterization crossing = map;
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> offset(0.002, 0.02);
  for (DomainPoint& p : crossing.phi) {
    if (corner_at(p) >= 0) continue;
    const bool on_side = p.alpha == 0 || p.beta == 0 || p.gamma() == 0;
    if (!on_side) continue;
    const double away = offset(random);
    // Toward the barycentre of the triangle that holds it.
    p = make_point(p.triangle, p.alpha + away * (1.0 / 3 - p.alpha), p.beta + away * (1.0 / 3 - p.beta));
  }
  return crossing;
}

TEST(DomainLocator, CoversTheDomainWhereImagesLieAcrossSidesAndAroundVertices) {
  for (const Domain& base : {fixtures::octahedron(), fixtures::icosahedron()}) {
    const auto [mesh, even] = fixtures::subdivided_sphere(base, 8);
    const Parameterization map = crossing_sides(even, 11);
    const DomainLocator locator(mesh, map);
    std::mt19937 random(4);
    int spanning = 0;
    for (int i = 0; i < 5000; ++i) {
      const DomainPoint p = random_point(base, random);
      const SurfacePoint found = locator.locate(p);
      ASSERT_TRUE(found.exists());
      if (image_of(mesh, map, found.triangle)->span != Span::kFace) ++spanning;
    }
    EXPECT_GT(spanning, 10);
    for (std::size_t v = 0; v < map.phi.size(); ++v) {
      EXPECT_EQ(position_at(mesh, locator.locate(map.phi[v])), Vec3d(mesh.positions[v]));
    }
  }
}

TEST(DomainLocator, IsContinuousAcrossTheSidesOfTheDomain) {
  const auto [mesh, even] = fixtures::subdivided_sphere(fixtures::octahedron(), 10);
  const Parameterization map = crossing_sides(even, 12);
  const DomainLocator locator(mesh, map);
  std::mt19937 random(5);
  std::uniform_int_distribution<std::int64_t> along(0, kLatticeOne);
  for (int i = 0; i < 2000; ++i) {
    const DomainSide s{i % map.domain.size(), i % 3};
    const DomainSide n = map.domain.neighbour(s);
    // The same point of the side, in the frames of both triangles.
    const LatticePoint on_side = inverse(corner_frame(s.side))({along(random), 0});
    const LatticePoint seen = inverse(transition(s.side, n.side))(on_side);
    const Vec3d here = position_at(mesh, locator.locate(domain_point(s.triangle, on_side)));
    const Vec3d there = position_at(mesh, locator.locate(domain_point(n.triangle, seen)));
    EXPECT_LT((here - there).length(), 1e-9);
  }
}

TEST(DomainLocator, RefusesAFoldedMap) {
  auto [mesh, map] = fixtures::subdivided_sphere(fixtures::octahedron(), 4);
  for (std::size_t v = 0; v < map.phi.size(); ++v) {
    DomainPoint& p = map.phi[v];
    if (p.alpha == 0 || p.beta == 0 || p.gamma() == 0) continue;
    p = make_point(p.triangle, p.beta > 0.4 ? 0.9 : 0.05, 0.05);
    break;
  }
  EXPECT_THROW(DomainLocator(mesh, map), Error);
}

TEST(DomainPointAt, TakesThePatchsCornersToItsEdgeAndBarycentres) {
  const Domain domain = fixtures::tetrahedron();
  for (const DomainSide edge : edges(domain)) {
    const PatchPlace place{domain.start(edge), domain.end(edge), edge, domain.neighbour(edge)};
    EXPECT_EQ(vertex_at(domain, domain_point_at(place, 0, 0)), place.a);
    EXPECT_EQ(vertex_at(domain, domain_point_at(place, 1, 1)), place.b);
    const DomainPoint left = domain_point_at(place, 0, 1);
    EXPECT_EQ(left, make_point(place.left.triangle, 1.0 / 3, 1.0 / 3));
    EXPECT_EQ(domain_point_at(place, 1, 0), make_point(place.right.triangle, 1.0 / 3, 1.0 / 3));
    // The diagonal is the edge: a quarter of the way from a to b.
    const DomainPoint quarter = domain_point_at(place, 0.25, 0.25);
    const std::array<double, 3> weights{quarter.alpha, quarter.beta, quarter.gamma()};
    EXPECT_EQ(quarter.triangle, edge.triangle);
    EXPECT_EQ(weights[edge.side], 0.75);
    EXPECT_EQ(weights[(edge.side + 1) % 3], 0.25);
  }
}

}  // namespace
}  // namespace lozenge
