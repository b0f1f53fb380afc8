#include "formats/domain/interpolation_domain.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "formats/domain/sphere_fixtures.h"

namespace lozenge {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kRoot3 = 1.7320508075688772935;
constexpr double kUnitTriangleArea = kRoot3 / 4;
constexpr int kLeastValence = 3;
constexpr int kMostValence = 12;
// Positions are rounded to multiples of 2^-40, about 1e-12; an irregular star may stretch that some thousandfold near
// its centre, from which the tests keep a distance.
constexpr double kRounding = 1e-9;

/// Two fans of k triangles over a k-gon: apexes k and k + 1 have valence k, the others 4.
Domain bipyramid(int k) {
  std::vector<std::array<DomainVertex, 3>> corners;
  for (int i = 0; i < k; ++i) {
    const int j = (i + 1) % k;
    corners.push_back({i, j, k});
    corners.push_back({j, i, k + 1});
  }
  return make_domain(corners, k + 2);
}

std::vector<Domain> all_domains() {
  std::vector<Domain> domains{fixtures::tetrahedron(), fixtures::octahedron(), fixtures::icosahedron()};
  for (int k = kLeastValence; k <= kMostValence; ++k) domains.push_back(bipyramid(k));
  return domains;
}

StarDomain apex_star(const Domain& domain, int k, StarShape shape) {
  return {domain, corner_of_each_vertex(domain)[k], shape};
}

std::array<double, 3> weights(const DomainPoint& p) { return {p.alpha, p.beta, p.gamma()}; }

double cross(const Vec2d& a, const Vec2d& b) { return a.x * b.y - a.y * b.x; }

/// Distance from p to the segment from a to b.
double distance_to_segment(const Vec2d& p, const Vec2d& a, const Vec2d& b) {
  const double along = std::clamp((p - a).dot(b - a) / (b - a).length2(), 0.0, 1.0);
  return (a + (b - a) * along - p).length();
}

/// A point of a slice as it lies in the unfolded unit triangle whose first corner is the star's centre.
Vec2d unfolded(const StarSlice& w) { return {w.first + w.second / 2, w.second * kRoot3 / 2}; }

class InterpolationDomain : public testing::Test {
 protected:
  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  int below(int n) { return std::uniform_int_distribution<int>(0, n - 1)(random_); }

  /// Inside of the triangle, with every weight above `margin`.
  DomainPoint point_in(DomainTriangleId t, double margin = 1e-3) {
    double a = uniform(0, 1), b = uniform(0, 1);
    if (a + b > 1) {
      a = 1 - a;
      b = 1 - b;
    }
    const double room = 1 - 3 * margin;
    return make_point(t, margin + a * room, margin + b * room);
  }

  StarSlice slice_point(int valence, double margin = 1e-3) {
    const DomainPoint p = point_in(0, margin);
    return {below(valence), p.alpha, p.beta};
  }

 private:
  std::mt19937 random_{12345};
};

using FaceDomains = InterpolationDomain;
using DiamondDomains = InterpolationDomain;
using StarDomains = InterpolationDomain;
using Interpolate = InterpolationDomain;
using Partitions = InterpolationDomain;

template <typename E>
void expect_there_and_back(const E& e, const DomainPoint& p) {
  const auto st = e.from_domain(p);
  ASSERT_TRUE(st);
  const auto again = e.to_domain(*st);
  ASSERT_TRUE(again);
  EXPECT_EQ(again->triangle, p.triangle);
  EXPECT_NEAR(again->alpha, p.alpha, kRounding);
  EXPECT_NEAR(again->beta, p.beta, kRounding);
}

TEST_F(FaceDomains, ComeBackToEveryPointOfTheirTriangle) {
  for (const Domain& d : all_domains()) {
    for (int i = 0; i < 200; ++i) {
      const DomainTriangleId t = below(d.size());
      expect_there_and_back(FaceDomain(d, t), point_in(t));
    }
  }
}

TEST_F(FaceDomains, HoldNoPointOfAnotherTriangleAndNoneOutsideOfTheUnitTriangle) {
  const Domain d = fixtures::icosahedron();
  for (int i = 0; i < 500; ++i) {
    const DomainTriangleId t = below(d.size());
    const DomainTriangleId other = (t + 1 + below(d.size() - 1)) % d.size();
    EXPECT_FALSE(FaceDomain(d, t).from_domain(point_in(other)));
    EXPECT_FALSE(FaceDomain(d, t).to_domain({uniform(0, 1), -uniform(0.001, 1)}));
  }
}

TEST_F(DiamondDomains, ComeBackToEveryPointOfBothTriangles) {
  for (const Domain& d : all_domains()) {
    for (int i = 0; i < 300; ++i) {
      const DomainSide side{below(d.size()), below(3)};
      const DiamondDomain diamond(d, side);
      expect_there_and_back(diamond, point_in(side.triangle));
      expect_there_and_back(diamond, point_in(d.neighbour(side).triangle));
    }
  }
}

TEST_F(DiamondDomains, GiveAPointOfTheSharedSideThePlaceThatItHasFromEitherTriangle) {
  for (const Domain& d : all_domains()) {
    for (int i = 0; i < 300; ++i) {
      const DomainSide side{below(d.size()), below(3)};
      const DomainSide across = d.neighbour(side);
      const double share = uniform(0, 1);
      const auto on = [](DomainSide s, double from_start) {
        std::array<double, 3> w{};
        w[s.side] = 1 - from_start;
        w[(s.side + 1) % 3] = from_start;
        return make_point(s.triangle, w[0], w[1]);
      };
      const DiamondDomain diamond(d, side);
      const Vec2d here = *diamond.from_domain(on(side, share));
      const Vec2d there = *diamond.from_domain(on(across, 1 - share));
      EXPECT_LT((here - there).length(), kRounding);
    }
  }
}

TEST_F(StarDomains, ComeBackToEveryPointForEveryValenceAndShape) {
  for (int k = kLeastValence; k <= kMostValence; ++k) {
    const Domain d = bipyramid(k);
    for (const double conformality : {0.0, 0.5, 1.0}) {
      const StarDomain star = apex_star(d, k, {conformality});
      ASSERT_EQ(star.valence(), k);
      for (int i = 0; i < 500; ++i) {
        SCOPED_TRACE(testing::Message() << "valence " << k << ", conformality " << conformality);
        expect_there_and_back(star, point_in(star.corners()[below(k)].triangle));
      }
    }
  }
}

TEST_F(StarDomains, ComeBackToEveryPointOfThePlaneThatTheyHold) {
  for (int k = kLeastValence; k <= kMostValence; ++k) {
    const Domain d = bipyramid(k);
    for (const double conformality : {0.0, 0.5, 1.0}) {
      const StarDomain star = apex_star(d, k, {conformality});
      const double radius = star_radius(k);
      int held = 0;
      for (int i = 0; i < 500; ++i) {
        const Vec2d st(uniform(-radius, radius), uniform(-radius, radius));
        if (st.length() < 0.01 * radius) continue;
        const auto p = star.to_domain(st);
        if (!p) continue;
        ++held;
        EXPECT_LT((*star.from_domain(*p) - st).length(), kRounding) << k << " " << conformality;
      }
      // The polygon fills a third of the square for the triangle, more for the others.
      EXPECT_GT(held, 100);
    }
  }
}

TEST_F(StarDomains, MapTheirCentreToTheVertexAndThePolygonsCornersToItsNeighbours) {
  for (int k = kLeastValence; k <= kMostValence; ++k) {
    const Domain d = bipyramid(k);
    for (const double conformality : {0.0, 0.5, 1.0}) {
      const StarDomain star = apex_star(d, k, {conformality});
      for (int i = 0; i < k; ++i) {
        const DomainCorner c = star.corners()[i];
        EXPECT_LT(star.from_domain(corner_point(c))->length(), kRounding);
        const DomainCorner outer{c.triangle, (c.corner + 1) % 3};
        EXPECT_LT((*star.from_domain(corner_point(outer)) - star_corner(k, i)).length(), kRounding);
      }
    }
  }
}

TEST_F(StarDomains, HoldNothingOutsideOfTheCircleAroundThePolygon) {
  for (int k = kLeastValence; k <= kMostValence; ++k) {
    const Domain d = bipyramid(k);
    for (const double conformality : {0.0, 1.0}) {
      const StarDomain star = apex_star(d, k, {conformality});
      for (int i = 0; i < 100; ++i) {
        const double angle = uniform(-kPi, kPi);
        const double radius = star_radius(k) * uniform(1.01, 3);
        EXPECT_FALSE(star.to_domain({radius * std::cos(angle), radius * std::sin(angle)}));
      }
    }
  }
}

TEST_F(StarDomains, KeepAreasForEveryValence) {
  for (int k = kLeastValence; k <= kMostValence; ++k) {
    for (int i = 0; i < 500; ++i) {
      const int slice = below(k);
      std::array<Vec2d, 3> flat, image;
      for (int c = 0; c < 3; ++c) {
        StarSlice w = slice_point(k);
        w.slice = slice;
        flat[c] = unfolded(w);
        image[c] = point_in_star(k, w, {0});
      }
      EXPECT_NEAR(cross(image[1] - image[0], image[2] - image[0]), cross(flat[1] - flat[0], flat[2] - flat[0]), 1e-12);
    }
  }
}

TEST_F(StarDomains, KeepAnglesForEveryValenceWhereTheyAreConformal) {
  for (int k = kLeastValence; k <= kMostValence; ++k) {
    for (int i = 0; i < 500; ++i) {
      const StarSlice w = slice_point(k, 0.02);
      constexpr double kStep = 1e-6;
      const auto move = [&](double x, double y) {
        const double second = y / (kRoot3 / 2);
        return point_in_star(k, {w.slice, w.first + x - second / 2, w.second + second}, {1});
      };
      const Vec2d along_x = (move(kStep, 0) - move(-kStep, 0)) / (2 * kStep);
      const Vec2d along_y = (move(0, kStep) - move(0, -kStep)) / (2 * kStep);
      // Cauchy and Riemann: the second derivative is the first, turned by a quarter.
      EXPECT_LT((along_y - Vec2d(-along_x.y, along_x.x)).length(), 1e-6 * along_x.length()) << k;
    }
  }
}

TEST_F(StarDomains, AreRigidForValenceSixInEveryShape) {
  for (const double conformality : {0.0, 0.3, 0.5, 1.0}) {
    for (int i = 0; i < 1000; ++i) {
      const StarSlice w = slice_point(6);
      const Vec2d p = unfolded(w);
      const double turn = w.slice * kPi / 3;
      const Vec2d expected(std::cos(turn) * p.x - std::sin(turn) * p.y, std::sin(turn) * p.x + std::cos(turn) * p.y);
      EXPECT_LT((point_in_star(6, w, {conformality}) - expected).length(), 1e-12);
    }
  }
}

TEST_F(StarDomains, AreRegularPolygonsWithTheAreaOfTheirTriangles) {
  for (int k = kLeastValence; k <= kMostValence; ++k) {
    double area = 0;
    const double side = (star_corner(k, 1) - star_corner(k, 0)).length();
    for (int i = 0; i < k; ++i) {
      area += cross(star_corner(k, i), star_corner(k, i + 1)) / 2;
      EXPECT_NEAR((star_corner(k, i + 1) - star_corner(k, i)).length(), side, 1e-12);
      EXPECT_NEAR(star_corner(k, i).length(), star_radius(k), 1e-12);
    }
    EXPECT_NEAR(area, k * kUnitTriangleArea, 1e-12) << k;
  }
}

TEST_F(StarDomains, InvertTheirSlicesBesideTheCentreAndTheSlicesSides) {
  for (int k = kLeastValence; k <= kMostValence; ++k) {
    for (const double conformality : {0.0, 0.25, 0.5, 0.75, 1.0}) {
      for (int i = 0; i < 300; ++i) {
        // From the very centre to the rim, from one side of the slice to the other.
        const double reach = std::pow(10, uniform(-4, 0));
        const double lean = i % 2 == 0 ? uniform(0, 1) : std::pow(10, uniform(-8, -1));
        const StarSlice w{below(k), reach * (1 - lean), reach * lean};
        const StarSlice again = slice_in_star(k, point_in_star(k, w, {conformality}), {conformality});
        EXPECT_EQ(again.slice, w.slice);
        EXPECT_NEAR(again.first, w.first, kRounding) << k << " " << conformality << " " << w.first << " " << w.second;
        EXPECT_NEAR(again.second, w.second, kRounding) << k << " " << conformality << " " << w.first << " " << w.second;
      }
    }
  }
}

/// Two triangles that share a vertex, often the same or neighbours.
std::array<DomainTriangleId, 2> two_around_a_vertex(const Domain& d, int vertex, int i, int j) {
  const auto around = corners_around(d, corner_of_each_vertex(d)[vertex]);
  return {around[i % around.size()].triangle, around[j % around.size()].triangle};
}

void expect_same(const DomainPoint& p, const DomainPoint& q) {
  EXPECT_EQ(p.triangle, q.triangle);
  EXPECT_NEAR(p.alpha, q.alpha, kRounding);
  EXPECT_NEAR(p.beta, q.beta, kRounding);
}

TEST_F(Interpolate, StartsAtOnePointAndEndsAtTheOther) {
  for (const Domain& d : all_domains()) {
    for (int i = 0; i < 300; ++i) {
      const auto [s, t] = two_around_a_vertex(d, below(d.vertex_count), below(100), below(100));
      const DomainPoint p = point_in(s), q = point_in(t);
      const auto start = interpolate(d, p, q, 0), end = interpolate(d, p, q, 1);
      ASSERT_TRUE(start && end);
      expect_same(*start, p);
      expect_same(*end, q);
    }
  }
}

TEST_F(Interpolate, StaysInTheDomainsWhichAreConvexAndGivesTheSameFromBothEnds) {
  for (const Domain& d : all_domains()) {
    for (int i = 0; i < 300; ++i) {
      const auto [s, t] = two_around_a_vertex(d, below(d.vertex_count), below(100), below(100));
      const DomainPoint p = point_in(s), q = point_in(t);
      for (const double share : {0.5, uniform(0, 1)}) {
        const auto forth = interpolate(d, p, q, share), back = interpolate(d, q, p, 1 - share);
        ASSERT_TRUE(forth && back);
        expect_same(*forth, *back);
      }
    }
  }
}

TEST_F(Interpolate, IsTheStraightSegmentInsideOfOneFace) {
  for (const Domain& d : all_domains()) {
    for (int i = 0; i < 300; ++i) {
      const DomainTriangleId t = below(d.size());
      const DomainPoint p = point_in(t), q = point_in(t);
      const double share = uniform(0, 1);
      const auto at = interpolate(d, p, q, share);
      ASSERT_TRUE(at);
      EXPECT_EQ(at->triangle, t);
      for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(weights(*at)[c], weights(p)[c] + share * (weights(q)[c] - weights(p)[c]), kRounding);
      }
    }
  }
}

TEST_F(Interpolate, FindsNothingBetweenTrianglesWithoutACommonVertex) {
  const Domain d = fixtures::icosahedron();
  int tried = 0;
  for (DomainTriangleId s = 0; s < d.size(); ++s) {
    for (DomainTriangleId t = 0; t < d.size(); ++t) {
      const auto &a = d.triangles[s].corners, &b = d.triangles[t].corners;
      if (std::find_first_of(a.begin(), a.end(), b.begin(), b.end()) != a.end()) continue;
      ++tried;
      EXPECT_FALSE(interpolate(d, point_in(s), point_in(t), 0.5));
    }
  }
  EXPECT_EQ(tried, 20 * 10);  // of the 20 faces, itself and 9 others touch a face
}

TEST_F(Partitions, PutEveryPointIntoTheHalfDiamondOfTheSideOppositeItsSmallestWeight) {
  // In the plane of the diamond: the rhombus through the ends of the side and the two barycentres.
  for (const Domain& d : all_domains()) {
    for (int i = 0; i < 300; ++i) {
      const DomainPoint p = point_in(below(d.size()));
      const DomainSide part = half_diamond_of(d, p);
      int holding = 0;
      for (int s = 0; s < 3; ++s) {
        const DomainSide here{p.triangle, s};
        const DiamondDomain diamond(d, here);
        const Vec2d st = *diamond.from_domain(p);
        const Vec2d a = plane_point(lattice_point(corner_point({p.triangle, s})));
        const Vec2d b = plane_point(lattice_point(corner_point({p.triangle, (s + 1) % 3})));
        const Vec2d centre = *diamond.from_domain(make_point(p.triangle, 1.0 / 3, 1.0 / 3));
        const Vec2d beyond = *diamond.from_domain(make_point(d.neighbour(here).triangle, 1.0 / 3, 1.0 / 3));
        const bool inside = cross(beyond - a, st - a) > 0 && cross(b - beyond, st - beyond) > 0 &&
                            cross(centre - b, st - b) > 0 && cross(a - centre, st - centre) > 0;
        holding += inside;
        EXPECT_EQ(inside, part == here || part == d.neighbour(here));
      }
      EXPECT_EQ(holding, 1);
    }
  }
}

TEST_F(Partitions, PutEveryPointIntoTheHalfStarOfTheCornerThatIsNearest) {
  for (const Domain& d : all_domains()) {
    for (int i = 0; i < 300; ++i) {
      const DomainPoint p = point_in(below(d.size()));
      int nearest = 0;
      const auto distance = [&](int c) {
        return (plane_point(lattice_point(corner_point({p.triangle, c}))) - plane_point(lattice_point(p))).length();
      };
      for (int c = 1; c < 3; ++c) {
        if (distance(c) < distance(nearest)) nearest = c;
      }
      EXPECT_EQ(half_star_of(d, p), d.corner(p.triangle, nearest));
    }
  }
}

TEST_F(Partitions, GiveHalfStarsThatAreThePolygonsThroughTheBarycentresForValenceSix) {
  constexpr int kApex = 6;
  const Domain d = bipyramid(6);
  const StarDomain star = apex_star(d, kApex, {});
  for (int i = 0; i < 1000; ++i) {
    const DomainPoint p = point_in(star.corners()[below(6)].triangle);
    const Vec2d st = *star.from_domain(p);
    bool inside = true;
    for (int s = 0; s < 6; ++s) {
      const Vec2d a = (star_corner(6, s) + star_corner(6, s + 1)) / 3;
      const Vec2d b = (star_corner(6, s + 1) + star_corner(6, s + 2)) / 3;
      inside &= cross(b - a, st - a) > 0;
    }
    EXPECT_EQ(inside, half_star_of(d, p) == kApex);
  }
}

TEST_F(Partitions, AgreeOnAPointOfASharedSideFromBothItsTriangles) {
  for (const Domain& d : all_domains()) {
    for (const DomainSide& side : edges(d)) {
      const DomainSide across = d.neighbour(side);
      for (int i = 0; i < 20; ++i) {
        // A multiple of 2^-20, so that both weights are exact.
        const double share = (1 + below((1 << 20) - 1)) / static_cast<double>(1 << 20);
        std::array<double, 3> here{}, there{};
        here[side.side] = there[(across.side + 1) % 3] = share;
        here[(side.side + 1) % 3] = there[across.side] = 1 - share;
        const DomainPoint p = make_point(side.triangle, here[0], here[1]);
        const DomainPoint q = make_point(across.triangle, there[0], there[1]);
        EXPECT_EQ(half_diamond_of(d, p), side);
        EXPECT_EQ(half_diamond_of(d, q), side);
        if (share != 0.5) {
          EXPECT_EQ(half_star_of(d, p), half_star_of(d, q));
        }
      }
    }
  }
}

TEST_F(Partitions, MeasureTheDistanceToTheirBordersInSidesOfTheTriangle) {
  const std::array<Vec2d, 3> corner{Vec2d(0, 0), Vec2d(1, 0), Vec2d(0.5, kRoot3 / 2)};
  const Vec2d centre = (corner[0] + corner[1] + corner[2]) / 3;
  for (int i = 0; i < 2000; ++i) {
    const DomainPoint p = point_in(0);
    const Vec2d st = plane_point(lattice_point(p));
    BorderDistances expected{10, 10, 10};
    for (int c = 0; c < 3; ++c) {
      const Vec2d a = corner[c], b = corner[(c + 1) % 3];
      expected.face = std::min(expected.face, distance_to_segment(st, a, b));
      expected.half_diamond = std::min(expected.half_diamond, distance_to_segment(st, centre, a));
      expected.half_star = std::min(expected.half_star, distance_to_segment(st, centre, (a + b) / 2));
    }
    const BorderDistances d = border_distances(p);
    EXPECT_NEAR(d.face, expected.face, kRounding);
    EXPECT_NEAR(d.half_diamond, expected.half_diamond, kRounding);
    EXPECT_NEAR(d.half_star, expected.half_star, kRounding);
  }
}

TEST_F(Partitions, LeaveNoPermanentBoundary) {
  // Let w0 <= w1 <= w2 be the weights and no distance exceed d: then w0 <= d / (sqrt(3)/2), w1 <= w0 + 2 d and
  // w2 <= w1 + 2 d, so 1 = w0 + w1 + w2 <= 2 sqrt(3) d + 6 d. Hence d >= 1 / (6 + 2 sqrt(3)) = 0.1057 sides, and where
  // all are equalities some point is that close to all three borders, so the bound can't be better.
  const double bound = 1 / (6 + 2 * kRoot3);
  constexpr int kGrid = 600;
  double least = 1;
  for (int i = 0; i <= kGrid; ++i) {
    for (int j = 0; i + j <= kGrid; ++j) {
      const BorderDistances d =
          border_distances(make_point(0, static_cast<double>(i) / kGrid, static_cast<double>(j) / kGrid));
      least = std::min(least, std::max({d.face, d.half_diamond, d.half_star}));
    }
  }
  EXPECT_GE(least, bound - kRounding);
  // No distance changes faster than the point moves, and some grid point is within 1 / kGrid of the worst.
  EXPECT_LE(least, bound + 1.0 / kGrid);
}

}  // namespace
}  // namespace lozenge
