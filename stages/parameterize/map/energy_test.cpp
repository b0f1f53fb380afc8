#include "stages/parameterize/map/energy.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace lozenge {
namespace {

std::vector<Energy> all_energies() {
  std::vector<Energy> energies{{EnergyKind::kMips, 3}, {EnergyKind::kSymmetricDirichlet, 3}};
  for (const double gamma : {0.0, 1.0, 2.0, 2.5, 3.0}) energies.push_back({EnergyKind::kIsometric, gamma});
  return energies;
}

/// A similarity costs nothing: the area doesn't count.
bool ignores_area(const Energy& e) {
  return e.kind == EnergyKind::kMips || (e.kind == EnergyKind::kIsometric && e.gamma == 0);
}

std::string name(const Energy& e) {
  return "kind " + std::to_string(static_cast<int>(e.kind)) + ", gamma " + std::to_string(e.gamma);
}

/// T and d of random linear maps with singular values from a thousandth to a thousand.
class Energies : public testing::Test {
 protected:
  struct Map {
    double t, d;
  };
  Map random_map(double most_decades = 3) {
    std::uniform_real_distribution<double> decades(-most_decades, most_decades);
    const double large = std::pow(10, decades(random_)), small = std::pow(10, decades(random_));
    return {large * large + small * small, large * small};
  }

 private:
  std::mt19937 random_{7};
};

TEST_F(Energies, HaveTheDerivativesThatDifferencesGive) {
  for (const Energy& e : all_energies()) {
    for (int i = 0; i < 2000; ++i) {
      const auto [t, d] = random_map(1);
      SCOPED_TRACE(name(e) + " at T " + std::to_string(t) + ", d " + std::to_string(d));
      const EnergyDerivatives at = differentiate(e, t, d);
      EXPECT_NEAR(at.f, evaluate(e, t, d), 1e-12 * at.f);
      // Central differences: an error of step^2 by the third derivative, and of 1e-16 / step by rounding; both below
      // 1e-8 of the function over its argument.
      const double dt = 1e-5 * t, dd = 1e-5 * d;
      const double by_t = (evaluate(e, t + dt, d) - evaluate(e, t - dt, d)) / (2 * dt);
      const double by_d = (evaluate(e, t, d + dd) - evaluate(e, t, d - dd)) / (2 * dd);
      EXPECT_NEAR(at.f_t, by_t, 1e-7 * at.f / t);
      EXPECT_NEAR(at.f_d, by_d, 1e-7 * at.f / d);
      const EnergyDerivatives less = differentiate(e, t, d - dd), more = differentiate(e, t, d + dd);
      EXPECT_NEAR(at.f_td, (more.f_t - less.f_t) / (2 * dd), 1e-7 * at.f / (t * d));
      EXPECT_NEAR(at.f_dd, (more.f_d - less.f_d) / (2 * dd), 1e-7 * at.f / (d * d));
      EXPECT_NEAR(differentiate(e, t + dt, d).f_t, differentiate(e, t - dt, d).f_t, 1e-12 * at.f_t);
    }
  }
}

TEST_F(Energies, AreOneForAnIsometryAndStationaryThereAlongSimilarities) {
  for (const Energy& e : all_energies()) {
    SCOPED_TRACE(name(e));
    EXPECT_DOUBLE_EQ(evaluate(e, 2.0, 1.0), 1);
    const EnergyDerivatives at = differentiate(e, 2.0, 1.0);
    EXPECT_DOUBLE_EQ(at.f, 1);
    EXPECT_NEAR(2 * at.f_t + at.f_d, 0, 1e-14);  // along T = 2 d
  }
}

TEST_F(Energies, AreNeverBelowOneForAnyMap) {
  for (const Energy& e : all_energies()) {
    for (int i = 0; i < 5000; ++i) {
      const auto [t, d] = random_map();
      EXPECT_GE(evaluate(e, t, d), 1 - 1e-12) << name(e) << " at T " << t << ", d " << d;
    }
  }
}

TEST_F(Energies, AreOneForEverySimilarityExactlyWhereTheyIgnoreTheArea) {
  for (const Energy& e : all_energies()) {
    for (int i = 0; i < 100; ++i) {
      const double d = random_map().d;
      if (std::abs(std::log(d)) < 0.01) continue;
      const double value = evaluate(e, 2 * d, d);
      if (ignores_area(e)) {
        EXPECT_NEAR(value, 1, 1e-12) << name(e);
      } else {
        EXPECT_GT(value, 1 + 1e-6) << name(e);
      }
    }
  }
}

TEST_F(Energies, GrowWithoutBoundWhereATriangleCollapses) {
  for (const Energy& e : all_energies()) {
    for (const double t : {0.01, 1.0, 2.0, 100.0}) {
      double last = 0, d = t / 2;  // no smaller than for a similarity
      for (int i = 0; i < 60; ++i, d /= 10) {
        const double value = evaluate(e, t, d);
        EXPECT_TRUE(d >= 1 || value > last) << name(e) << " at T " << t << ", d " << d;
        last = value;
      }
      EXPECT_GT(last, 1e50) << name(e);
    }
  }
}

TEST_F(Energies, GrowWithoutBoundWithTheAreaUnlessTheyIgnoreIt) {
  for (const Energy& e : all_energies()) {
    if (ignores_area(e)) continue;
    for (const double stretch : {1.0, 1.5, 10.0}) {
      double last = 0, d = 1;
      for (int i = 0; i < 60; ++i, d *= 10) {
        const double value = evaluate(e, 2 * stretch * d, d);
        EXPECT_GT(value, last) << name(e) << " at d " << d;
        last = value;
      }
      EXPECT_GT(last, 1e50) << name(e);
    }
  }
}

TEST_F(Energies, OfIsometryAreThePowersOfTheAreaDistortionTimesTheConformal) {
  for (int i = 0; i < 1000; ++i) {
    const auto [t, d] = random_map();
    const double area = (d + 1 / d) / 2, conformal = t / (2 * d);
    double expected = conformal;
    for (const double gamma : {0.0, 1.0, 2.0, 3.0}) {
      EXPECT_NEAR(evaluate({EnergyKind::kIsometric, gamma}, t, d), expected, 1e-12 * expected);
      expected *= area;
    }
    EXPECT_NEAR(evaluate({EnergyKind::kMips, 3}, t, d), conformal, 1e-12 * conformal);
  }
}

}  // namespace
}  // namespace lozenge
