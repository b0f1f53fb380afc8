#include "formats/domain/partition.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "formats/domain/open_fixtures.h"
#include "formats/domain/sphere_fixtures.h"

namespace lozenge {
namespace {

const std::array<Vec2d, 3> kCorner{Vec2d(0, 0), Vec2d(1, 0), Vec2d(0.5, std::sqrt(0.75))};
const Vec2d kCentre = (kCorner[0] + kCorner[1] + kCorner[2]) / 3;

std::vector<Domain> all_domains() {
  return {fixtures::tetrahedron(), fixtures::octahedron(), fixtures::icosahedron(), fixtures::hemisphere(2).map.domain};
}

double distance_to_segment(const Vec2d& p, const Vec2d& a, const Vec2d& b) {
  const double along = std::clamp((p - a).dot(b - a) / (b - a).length2(), 0.0, 1.0);
  return (a + (b - a) * along - p).length();
}

class Partitions : public testing::Test {
 protected:
  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  int below(int n) { return std::uniform_int_distribution<int>(0, n - 1)(random_); }

  DomainPoint point_in(DomainTriangleId t) {
    double a = uniform(0, 1), b = uniform(0, 1);
    if (a + b > 1) {
      a = 1 - a;
      b = 1 - b;
    }
    return make_point(t, a, b);
  }

 private:
  std::mt19937 random_{12345};
};

Vec2d plane_point_of(const DomainPoint& p) { return plane_point(lattice_point(p)); }

TEST_F(Partitions, PutEveryPointIntoTheHalfDiamondWhoseHalfOfItsTriangleHoldsIt) {
  for (const Domain& d : all_domains()) {
    for (int i = 0; i < 300; ++i) {
      const DomainPoint p = point_in(below(d.size()));
      const Vec2d st = plane_point_of(p);
      const std::int32_t part = part_of(d, p, Partition::kHalfDiamonds);
      int holding = 0;
      for (int s = 0; s < 3; ++s) {
        const Vec2d &a = kCorner[s], &b = kCorner[(s + 1) % 3];
        const bool inside =
            (b - a).cross(st - a) > 0 && (kCentre - b).cross(st - b) > 0 && (a - kCentre).cross(st - kCentre) > 0;
        holding += inside;
        const DomainSide across = d.neighbour({p.triangle, s});
        const bool named = part == 3 * p.triangle + s || (across.exists() && part == 3 * across.triangle + across.side);
        EXPECT_EQ(inside, named);
      }
      EXPECT_EQ(holding, 1);
    }
  }
}

TEST_F(Partitions, PutEveryPointIntoTheHalfStarOfTheCornerThatIsNearest) {
  for (const Domain& d : all_domains()) {
    for (int i = 0; i < 300; ++i) {
      const DomainPoint p = point_in(below(d.size()));
      const auto nearer = [&](const Vec2d& a, const Vec2d& b) {
        return (a - plane_point_of(p)).length() < (b - plane_point_of(p)).length();
      };
      const auto nearest = std::min_element(kCorner.begin(), kCorner.end(), nearer) - kCorner.begin();
      EXPECT_EQ(part_of(d, p, Partition::kHalfStars), d.corner(p.triangle, static_cast<int>(nearest)));
    }
  }
}

TEST_F(Partitions, AgreeOnAPointOfASharedSideFromBothItsTriangles) {
  for (const Domain& d : all_domains()) {
    for (const DomainSide& side : edges(d)) {
      const DomainSide across = d.neighbour(side);
      if (!across.exists()) continue;
      for (int i = 0; i < 20; ++i) {
        // A multiple of 2^-20, so that both weights are exact.
        const double share = (1 + below((1 << 20) - 1)) / static_cast<double>(1 << 20);
        std::array<double, 3> here{}, there{};
        here[side.side] = there[(across.side + 1) % 3] = share;
        here[(side.side + 1) % 3] = there[across.side] = 1 - share;
        const std::int32_t edge = 3 * side.triangle + side.side;
        EXPECT_EQ(part_of(d, side.triangle, here, Partition::kHalfDiamonds), edge);
        EXPECT_EQ(part_of(d, across.triangle, there, Partition::kHalfDiamonds), edge);
        if (share == 0.5) continue;
        EXPECT_EQ(part_of(d, side.triangle, here, Partition::kHalfStars),
                  part_of(d, across.triangle, there, Partition::kHalfStars));
      }
    }
  }
}

TEST(Partition, LeavesNoPermanentBoundary) {
  // In a triangle, half-diamonds end on the segments from the barycentre to the corners, half-stars on those to the
  // middles of the sides. Let w0 <= w1 <= w2 be the weights and no distance exceed d, in sides of the triangle: then
  // w0 <= d / (sqrt(3)/2), w1 <= w0 + 2 d and w2 <= w1 + 2 d, so 1 = w0 + w1 + w2 <= 2 sqrt(3) d + 6 d. Hence
  // d >= 1 / (6 + 2 sqrt(3)) = 0.1057, and where all are equalities some point is that close to all three borders, so
  // the bound can't be better.
  const double bound = 1 / (6 + 2 * std::sqrt(3.0));
  constexpr int kGrid = 300;
  double least = 1;
  for (int i = 0; i <= kGrid; ++i) {
    for (int j = 0; i + j <= kGrid; ++j) {
      const Vec2d p = kCorner[1] * (static_cast<double>(i) / kGrid) + kCorner[2] * (static_cast<double>(j) / kGrid);
      double face = 1, half_diamond = 1, half_star = 1;
      for (int c = 0; c < 3; ++c) {
        const Vec2d &a = kCorner[c], &b = kCorner[(c + 1) % 3];
        face = std::min(face, distance_to_segment(p, a, b));
        half_diamond = std::min(half_diamond, distance_to_segment(p, kCentre, a));
        half_star = std::min(half_star, distance_to_segment(p, kCentre, (a + b) / 2));
      }
      least = std::min(least, std::max({face, half_diamond, half_star}));
    }
  }
  EXPECT_GE(least, bound - 1e-9);
  // No distance changes faster than the point moves, and some grid point is within 1 / kGrid of the worst.
  EXPECT_LE(least, bound + 1.0 / kGrid);
}

}  // namespace
}  // namespace lozenge
