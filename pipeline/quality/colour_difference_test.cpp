#include "pipeline/quality/colour_difference.h"

#include <gtest/gtest.h>

namespace lozenge {
namespace {

struct Pair {
  Vec3d first;
  Vec3d second;
  double difference;
};

TEST(ColourDifference, IsThatOfThePublishedTestData) {
  // Sharma, Wu, Dalal, Table 1.
  const Pair pairs[] = {
      {{50, 2.6772, -79.7751}, {50, 0, -82.7485}, 2.0425},
      {{50, 3.1571, -77.2803}, {50, 0, -82.7485}, 2.8615},
      {{50, 2.8361, -74.0200}, {50, 0, -82.7485}, 3.4412},
      {{50, -1.3802, -84.2814}, {50, 0, -82.7485}, 1.0000},
      {{50, 2.5, 0}, {50, 0, -2.5}, 4.3065},
      {{50, 2.5, 0}, {73, 25, -18}, 27.1492},
      {{60.2574, -34.0099, 36.2677}, {60.4626, -34.1751, 39.4387}, 1.2644},
  };
  for (const Pair& pair : pairs) {
    EXPECT_NEAR(ciede2000(pair.first, pair.second), pair.difference, 5e-5);
    EXPECT_NEAR(ciede2000(pair.second, pair.first), pair.difference, 5e-5) << "the other way round";
  }
}

TEST(ColourDifference, BlackAndWhiteAreTheEndsOfLightness) {
  EXPECT_NEAR((lab_of_linear({1, 1, 1}) - Vec3d(100, 0, 0)).length(), 0, 0.02);
  EXPECT_EQ(lab_of_linear({0, 0, 0}), Vec3d(0, 0, 0));
  EXPECT_NEAR(ciede2000(lab_of_linear({1, 1, 1}), lab_of_linear({0, 0, 0})), 100, 0.01);
}

}  // namespace
}  // namespace lozenge
