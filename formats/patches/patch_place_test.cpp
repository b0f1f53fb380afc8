#include "formats/patches/patch_place.h"

#include <gtest/gtest.h>

#include <random>

#include "formats/domain/development.h"
#include "formats/domain/sphere_fixtures.h"

namespace lozenge {
namespace {

std::vector<PatchPlace> places_of(const Domain& domain) {
  std::vector<PatchPlace> places;
  for (const DomainSide edge : edges(domain)) {
    places.push_back({domain.start(edge), domain.end(edge), edge, domain.neighbour(edge)});
  }
  return places;
}

TEST(DomainPointAt, TakesThePatchsCornersToItsEdgeAndBarycentres) {
  const Domain domain = fixtures::tetrahedron();
  for (const PatchPlace& place : places_of(domain)) {
    EXPECT_EQ(vertex_at(domain, domain_point_at(place, 0, 0)), place.a);
    EXPECT_EQ(vertex_at(domain, domain_point_at(place, 1, 1)), place.b);
    EXPECT_EQ(domain_point_at(place, 0, 1), make_point(place.left.triangle, 1.0 / 3, 1.0 / 3));
    EXPECT_EQ(domain_point_at(place, 1, 0), make_point(place.right.triangle, 1.0 / 3, 1.0 / 3));
    const DomainPoint quarter = domain_point_at(place, 0.25, 0.25);
    const std::array<double, 3> weights{quarter.alpha, quarter.beta, quarter.gamma()};
    EXPECT_EQ(quarter.triangle, place.left.triangle);
    EXPECT_EQ(weights[place.left.side], 0.75);
    EXPECT_EQ(weights[(place.left.side + 1) % 3], 0.25);
  }
}

TEST(DomainPointAt, IsAffineOverTheWholePatch) {
  const Domain domain = fixtures::octahedron();
  std::mt19937 random(1);
  std::uniform_real_distribution<double> number(0, 1);
  for (const PatchPlace& place : places_of(domain)) {
    // Both triangles unfolded into the left one's frame.
    const LatticeMotion across = transition(place.left.side, place.right.side);
    const auto flat = [&](double u, double v) {
      const DomainPoint p = domain_point_at(place, u, v);
      return plane_point(v >= u ? lattice_point(p) : across(lattice_point(p)));
    };
    const Vec2d origin = flat(0, 0);
    const Vec2d along_v = flat(0, 1) - origin;
    const Vec2d along_u = flat(1, 0) - origin;
    for (int i = 0; i < 100; ++i) {
      const double u = number(random);
      const double v = number(random);
      EXPECT_LT((flat(u, v) - (origin + along_u * u + along_v * v)).length(), 1e-11);
    }
  }
}

}  // namespace
}  // namespace lozenge
