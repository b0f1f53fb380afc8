#include "stages/parameterize/relax/wedge.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace lozenge {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A vertex at the origin with source triangles of random shapes around it.
class RingOfTriangles {
 public:
  RingOfTriangles(int count, unsigned seed) : random_(seed) {
    for (int i = 0; i < count; ++i) {
      const double angle = 2 * std::acos(-1.0) * (i + 0.3 * number(0, 1)) / std::max(count, 3);
      ring_.push_back(Vec2d(std::cos(angle), std::sin(angle)) * number(0.5, 1.5));
      const std::vector<Vec3f> source{point(), point(), point()};
      rest_.push_back(rest_shape(source, {0, 1, 2}, 1, kFlattest));
      corner_.push_back(i % 3);
    }
    // Less than a full turn has a last neighbour of its own.
    ring_.push_back(count < 3 ? Vec2d(-ring_.back().y, ring_.back().x) : ring_.front());
  }

  Wedges wedges(double scale) const {
    Wedges wedges;
    wedges.start(scale);
    for (std::size_t i = 0; i < rest_.size(); ++i) wedges.add(rest_[i], corner_[i], ring_[i], ring_[i + 1]);
    wedges.close();
    return wedges;
  }

  /// The energy with the vertex at x, from the definition: T and d of each triangle's linear map.
  double energy_with_vertex_at(const Energy& energy, const Vec2d& x, double scale) const {
    double sum = 0;
    for (std::size_t i = 0; i < rest_.size(); ++i) {
      const Vec2d p = ring_[i], q = ring_[i + 1];
      const RestShape& rest = rest_[i];
      const int c = corner_[i];
      const double d = ((p.x - x.x) * (q.y - x.y) - (p.y - x.y) * (q.x - x.x)) * rest.inverse_area * scale;
      if (!(d > 0)) return kInfinity;
      const double t = (rest.weight[c] * (q - p).length2() + rest.weight[(c + 1) % 3] * (q - x).length2() +
                        rest.weight[(c + 2) % 3] * (p - x).length2()) *
                       scale;
      sum += rest.share * evaluate(energy, t, d);
    }
    return sum;
  }

  double share() const {
    double sum = 0;
    for (const RestShape& rest : rest_) sum += rest.share;
    return sum;
  }

  double number(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }

 private:
  Vec3f point() {
    const auto coordinate = [&] { return static_cast<float>(number(-1, 1)); };
    const float x = coordinate(), y = coordinate(), z = coordinate();
    return {x, y, z};
  }

  std::mt19937 random_;
  std::vector<Vec2d> ring_;
  std::vector<RestShape> rest_;
  std::vector<int> corner_;
};

const std::vector<Energy> kEnergies{{EnergyKind::kMips, 3},
                                    {EnergyKind::kSymmetricDirichlet, 3},
                                    {EnergyKind::kIsometric, 3},
                                    {EnergyKind::kIsometric, 2.5}};

TEST(Wedges, HaveTheEnergyOfTheirTrianglesWhereverTheVertexGoes) {
  for (int count = 1; count <= 12; ++count) {
    for (unsigned seed = 0; seed < 20; ++seed) {
      RingOfTriangles ring(count, seed);
      const double scale = ring.number(0.5, 2);
      const Wedges wedges = ring.wedges(scale);
      EXPECT_NEAR(wedges.share(), ring.share(), 1e-12 * ring.share());
      for (const Energy& energy : kEnergies) {
        const Vec2d x(ring.number(-0.1, 0.1), ring.number(-0.1, 0.1));
        const double expected = ring.energy_with_vertex_at(energy, x, scale);
        if (expected < kInfinity) {
          EXPECT_NEAR(energy_at(energy, wedges, x), expected, 1e-9 * expected);
        }
        const double here = ring.energy_with_vertex_at(energy, {0, 0}, scale);
        if (here < kInfinity) {
          EXPECT_NEAR(newton_step(energy, wedges).energy, here, 1e-9 * here);
        }
      }
    }
  }
}

TEST(Wedges, HaveAStepThatDescendsAndFoldsNothing) {
  for (int count = 3; count <= 12; ++count) {
    for (unsigned seed = 0; seed < 20; ++seed) {
      RingOfTriangles ring(count, seed);
      const Wedges wedges = ring.wedges(1);
      for (const Energy& energy : kEnergies) {
        const NewtonStep newton = newton_step(energy, wedges);
        if (!(newton.energy < kInfinity) || !(newton.step.length() > 0)) continue;
        EXPECT_LT(energy_at(energy, wedges, newton.step), kInfinity);
        EXPECT_LT(energy_at(energy, wedges, newton.step * 1e-4), newton.energy);
      }
    }
  }
}

TEST(Wedges, AreFoldedWhereAnyOfThemIs) {
  for (int count = 3; count <= 9; ++count) {
    const Wedges wedges = RingOfTriangles(count, 1).wedges(1);
    // Beyond the rim in every direction: another triangle is folded each time, in either of a pair.
    for (int i = 0; i < 2 * count; ++i) {
      const double angle = std::acos(-1.0) * i / count;
      EXPECT_EQ(energy_at({}, wedges, Vec2d(std::cos(angle), std::sin(angle)) * 2.0), kInfinity);
    }
  }
}

}  // namespace
}  // namespace lozenge
