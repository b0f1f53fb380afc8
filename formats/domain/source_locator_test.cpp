#include "formats/domain/source_locator.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "formats/base/error.h"
#include "formats/domain/open_fixtures.h"
#include "formats/domain/sphere_fixtures.h"
#include "formats/surface/boundary.h"

namespace lozenge {
namespace {

/// Moves every position by a rigid step in its unfolded surroundings, so that images lie across sides; the vertices of
/// the domain stay.
Parameterization slid_across_sides(Parameterization map, double distance, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> offset(-distance, distance);
  for (DomainPoint& p : map.phi) {
    if (corner_at(p) >= 0) continue;
    LatticePoint at = lattice_point(p);
    const auto step = [&] { return static_cast<std::int64_t>(offset(random) * static_cast<double>(kLatticeOne)); };
    at = at + LatticePoint{step(), step()};
    DomainTriangleId t = p.triangle;
    for (int hop = 0; hop < 4 && !in_triangle(at); ++hop) {
      const int side = at.v < 0 ? 0 : at.u < 0 ? 2 : 1;
      const DomainSide n = map.domain.neighbour({t, side});
      at = inverse(transition(side, n.side))(at);
      t = n.triangle;
    }
    if (in_triangle(at)) p = domain_point(t, at);
  }
  return map;
}

struct Case {
  SourceMesh mesh;
  Parameterization map;
};

/// Spheres over domains whose vertices join 3, 4 and 5 triangles; maps with images inside domain triangles, and with
/// images that lie across their sides and around their corners.
std::vector<Case> cases() {
  std::vector<Case> found;
  for (const Domain& base : {fixtures::tetrahedron(), fixtures::octahedron(), fixtures::icosahedron()}) {
    for (const int n : {1, 2, 3, 5, 12}) {
      auto [mesh, map] = fixtures::subdivided_sphere(base, n);
      found.push_back({mesh, map});
      fixtures::jitter(map, 0.25 / n, 5);
      found.push_back({mesh, map});
      // Around a vertex of three triangles, and on a coarse grid, positions so far apart do not tell which way an image
      // goes.
      if (n >= 3 && base.size() > 4) found.push_back({mesh, slid_across_sides(map, 0.12 / n, 9)});
    }
  }
  for (fixtures::OpenSurface& open : fixtures::open_surfaces()) found.push_back({open.mesh, open.map});
  return found;
}

std::vector<DomainPoint> probes(const Domain& domain, std::mt19937& random) {
  std::vector<DomainPoint> found;
  std::uniform_real_distribution<double> number(0, 1);
  for (DomainTriangleId t = 0; t < domain.size(); ++t) {
    for (int c = 0; c < 3; ++c) found.push_back(corner_point({t, c}));
    for (int i = 0; i < 20; ++i) {
      const double alpha = number(random);
      found.push_back(make_point(t, alpha, number(random) * (1 - alpha)));
      found.push_back(make_point(t, alpha, 1 - alpha));
      found.push_back(make_point(t, i / 32.0, 0));
    }
  }
  return found;
}

bool holds(const std::array<LatticePoint, 3>& c, LatticePoint p) {
  return doubled_area(c[0], c[1], p) >= 0 && doubled_area(c[1], c[2], p) >= 0 && doubled_area(c[2], c[0], p) >= 0;
}

TEST(SourceLocator, AnswersTheFirstImageThatHoldsThePlace) {
  for (const Case& c : cases()) {
    const SourceLocator all(c.mesh, c.map);
    std::mt19937 random(11);
    for (const DomainPoint& place : probes(c.map.domain, random)) {
      const auto found = TriangleLocator(all, place.triangle).find(lattice_point(place));
      TriangleId first = -1;
      for (const SourceLocator::Image& image : all.over(place.triangle)) {
        if (first < 0 && holds(all.corners(image), lattice_point(place))) first = image.source;
      }
      ASSERT_TRUE(found.has_value());
      EXPECT_EQ(found->triangle, first);
      EXPECT_NEAR(found->weights.x + found->weights.y + found->weights.z, 1, 1e-15);
    }
  }
}

/// Area of the part of the image inside the domain triangle, in units of the triangle's.
double overlap_area(const std::array<LatticePoint, 3>& corners) {
  std::vector<Vec2d> part;
  for (const LatticePoint& p : corners) {
    part.emplace_back(std::ldexp(static_cast<double>(p.u), -40), std::ldexp(static_cast<double>(p.v), -40));
  }
  const std::array<Vec3d, 3> lines{Vec3d(1, 0, 0), Vec3d(0, 1, 0), Vec3d(-1, -1, 1)};  // u >= 0, v >= 0, u + v <= 1
  for (const Vec3d& line : lines) {
    std::vector<Vec2d> kept;
    for (std::size_t i = 0; i < part.size(); ++i) {
      const Vec2d a = part[i];
      const Vec2d b = part[(i + 1) % part.size()];
      const double at_a = line.x * a.x + line.y * a.y + line.z;
      const double at_b = line.x * b.x + line.y * b.y + line.z;
      if (at_a >= 0) kept.push_back(a);
      if ((at_a > 0 && at_b < 0) || (at_a < 0 && at_b > 0)) kept.push_back(a + (b - a) * (at_a / (at_a - at_b)));
    }
    part = kept;
  }
  double doubled = 0;
  for (std::size_t i = 0; i < part.size(); ++i) {
    const Vec2d a = part[i];
    const Vec2d b = part[(i + 1) % part.size()];
    doubled += a.x * b.y - a.y * b.x;
  }
  return doubled;
}

TEST(SourceLocator, ListsPiecesThatTileEveryDomainTriangle) {
  for (const Case& c : cases()) {
    const SourceLocator all(c.mesh, c.map);
    for (DomainTriangleId t = 0; t < c.map.domain.size(); ++t) {
      double area = 0;
      for (const SourceLocator::Image& image : all.over(t)) {
        const double piece = overlap_area(all.corners(image));
        EXPECT_GT(piece, 0) << "source triangle " << image.source << " doesn't overlap domain triangle " << t;
        area += piece;
      }
      EXPECT_NEAR(area, 1, 1e-9);
    }
  }
}

TEST(SourceLocator, GivesEveryVertexBackExactly) {
  for (const Case& c : cases()) {
    const DomainLocator locator(c.mesh, c.map);
    for (std::size_t v = 0; v < c.map.phi.size(); ++v) {
      const auto found = locator.find(c.map.phi[v]);
      ASSERT_TRUE(found.has_value());
      EXPECT_EQ(position_at(c.mesh, *found), c.mesh.positions[v]);
    }
  }
}

TEST(SourceLocator, FindsPlacesOfTheDomainsBoundaryOnTheSourcesBoundaryExactly) {
  for (const fixtures::OpenSurface& open : fixtures::open_surfaces()) {
    const DomainLocator locator(open.mesh, open.map);
    const std::vector<BoundarySide> sides = boundary_sides({open.mesh.positions, open.mesh.triangles});
    for (const DomainSide side : edges(open.map.domain)) {
      if (open.map.domain.neighbour(side).exists()) continue;
      for (int k = 0; k <= 64; ++k) {
        std::array<double, 3> weights{};
        weights[side.side] = 1 - k / 64.0;
        weights[(side.side + 1) % 3] = k / 64.0;
        const auto found = locator.find(make_point(side.triangle, weights[0], weights[1]));
        ASSERT_TRUE(found) << open.name;
        std::vector<VertexId> ends;
        for (int c = 0; c < 3; ++c) {
          if (found->weights[c] != 0) ends.push_back(open.mesh.triangles[found->triangle][c]);
        }
        const bool on_one_side = std::any_of(sides.begin(), sides.end(), [&](const BoundarySide& s) {
          return std::all_of(ends.begin(), ends.end(), [&](VertexId v) { return v == s[0] || v == s[1]; });
        });
        EXPECT_TRUE(on_one_side) << open.name << ", side " << side.side << " of " << side.triangle << ", " << k;
      }
    }
  }
}

TEST(SourceLocator, FindsPlacesUnderLongThinImages) {
  // A fan of slivers from one corner of each domain triangle: bins along a sliver, not all in its bounding box.
  const Domain base = fixtures::octahedron();
  SourceMesh mesh;
  Parameterization map{base, {}};
  constexpr int kSlivers = 300;
  for (DomainTriangleId t = 0; t < base.size(); ++t) {
    const auto first = static_cast<VertexId>(map.phi.size());
    map.phi.push_back(corner_point({t, 0}));
    for (int i = 0; i <= kSlivers; ++i) {
      map.phi.push_back(make_point(t, 0, 1 - static_cast<double>(i) / kSlivers));
      if (i > 0) mesh.triangles.push_back({first, first + i, first + i + 1});
    }
  }
  mesh.positions.assign(map.phi.size(), Vec3f(0, 0, 0));
  const DomainLocator locator(mesh, map);
  std::mt19937 random(2);
  for (const DomainPoint& place : probes(base, random)) EXPECT_TRUE(locator.find(place).has_value());
}

TEST(SourceLocator, RefusesAFoldedImage) {
  auto [mesh, map] = fixtures::subdivided_sphere(fixtures::icosahedron(), 4);
  std::swap(mesh.triangles[17][0], mesh.triangles[17][1]);
  try {
    const SourceLocator locator(mesh, map);
    FAIL() << "a folded triangle was taken";
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ExitCode::kUnusableInput);
    EXPECT_NE(std::string(e.what()).find("source triangle 17"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace lozenge
