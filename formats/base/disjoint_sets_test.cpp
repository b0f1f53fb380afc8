#include "formats/base/disjoint_sets.h"

#include <gtest/gtest.h>

#include <random>

namespace lozenge {
namespace {

TEST(DisjointSets, NameEachSetByItsLowestNumber) {
  // Against labels that are rewritten at each join.
  constexpr int kSize = 60;
  std::mt19937 random(3);
  for (int round = 0; round < 50; ++round) {
    DisjointSets<int> sets(kSize);
    std::vector<int> labels(kSize);
    std::iota(labels.begin(), labels.end(), 0);
    for (int step = 0; step < 40; ++step) {
      const int a = static_cast<int>(random() % kSize);
      const int b = static_cast<int>(random() % kSize);
      const auto [low, high] = std::minmax(labels[a], labels[b]);
      EXPECT_EQ(sets.join(a, b), low != high);
      std::replace(labels.begin(), labels.end(), int(high), int(low));
    }
    for (int x = 0; x < kSize; ++x) EXPECT_EQ(sets.root(x), labels[x]);
  }
}

}  // namespace
}  // namespace lozenge
