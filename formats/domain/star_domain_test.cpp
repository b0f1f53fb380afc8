#include "formats/domain/star_domain.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

namespace lozenge {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kRoot3 = 1.7320508075688772935;
constexpr double kUnitTriangleArea = kRoot3 / 4;
constexpr int kLeastValence = 3;
constexpr int kMostValence = 12;
// An irregular star may stretch rounding some thousandfold near its centre.
constexpr double kRounding = 1e-9;

/// A point of a slice as it lies in the unfolded unit triangle whose first corner is the star's centre.
Vec2d unfolded(const StarSlice& w) { return {w.first + w.second / 2, w.second * kRoot3 / 2}; }

class StarDomains : public testing::Test {
 protected:
  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  int below(int n) { return std::uniform_int_distribution<int>(0, n - 1)(random_); }

  /// Inside of a slice, with every weight above `margin`.
  StarSlice slice_point(int valence, double margin = 1e-3) {
    double a = uniform(0, 1), b = uniform(0, 1);
    if (a + b > 1) {
      a = 1 - a;
      b = 1 - b;
    }
    const double room = 1 - 3 * margin;
    return {below(valence), margin + a * room, margin + b * room};
  }

 private:
  std::mt19937 random_{12345};
};

TEST_F(StarDomains, MapTheirCentreToTheOriginAndOuterCornersToThoseOfThePolygon) {
  for (int k = kLeastValence; k <= kMostValence; ++k) {
    for (const double conformality : {0.0, 0.5, 1.0}) {
      for (int i = 0; i < k; ++i) {
        EXPECT_EQ(point_in_star(k, {i, 0, 0}, {conformality}).length(), 0);
        EXPECT_LT((point_in_star(k, {i, 1, 0}, {conformality}) - star_corner(k, i)).length(), 1e-12);
        EXPECT_LT((point_in_star(k, {i, 0, 1}, {conformality}) - star_corner(k, i + 1)).length(), 1e-12);
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
      EXPECT_NEAR((image[1] - image[0]).cross(image[2] - image[0]), (flat[1] - flat[0]).cross(flat[2] - flat[0]),
                  1e-12);
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
      area += star_corner(k, i).cross(star_corner(k, i + 1)) / 2;
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

}  // namespace
}  // namespace lozenge
