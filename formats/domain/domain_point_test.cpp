#include "formats/domain/domain_point.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace lozenge {
namespace {

TEST(LatticeMotion, EachTransitionJoinsTheSharedSideEndToEnd) {
  const std::array<LatticePoint, 3> corner{LatticePoint{0, 0}, {kLatticeOne, 0}, {0, kLatticeOne}};
  for (int from = 0; from < 3; ++from) {
    for (int to = 0; to < 3; ++to) {
      const LatticeMotion across = transition(from, to);
      EXPECT_EQ(across(corner[to]), corner[(from + 1) % 3]);
      EXPECT_EQ(across(corner[(to + 1) % 3]), corner[from]);
      const LatticePoint far = across(corner[(to + 2) % 3]);
      EXPECT_LT(doubled_area(corner[from], corner[(from + 1) % 3], far), 0);
      EXPECT_EQ(composed(transition(to, from), across)(far), far) << "going back undoes it";
      EXPECT_EQ(inverse(across)(across(far)), far);
    }
  }
}

TEST(LatticeMotion, KeepsAreasExactlyAndDistancesToRounding) {
  std::mt19937_64 random(7);
  std::uniform_int_distribution<std::int64_t> in_cell(-kLatticeOne, kLatticeOne);
  for (int i = 0; i < 1000; ++i) {
    const LatticeMotion motion{i % 6, {in_cell(random), in_cell(random)}};
    const LatticePoint p{in_cell(random), in_cell(random)}, q{in_cell(random), in_cell(random)},
        r{in_cell(random), in_cell(random)};
    EXPECT_TRUE(doubled_area(motion(p), motion(q), motion(r)) == doubled_area(p, q, r));
    EXPECT_NEAR((plane_point(motion(p)) - plane_point(motion(q))).length(), (plane_point(p) - plane_point(q)).length(),
                1e-14);
  }
}

TEST(DomainPoint, KeepsItsBarycentricsThroughTheLattice) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> share(0, 1);
  for (int i = 0; i < 1000; ++i) {
    const double alpha = share(random);
    const DomainPoint p = make_point(3, alpha, (1 - alpha) * share(random));
    EXPECT_EQ(domain_point(3, lattice_point(p)), p);
    EXPECT_TRUE(in_triangle(lattice_point(p)));
  }
}

}  // namespace
}  // namespace lozenge
