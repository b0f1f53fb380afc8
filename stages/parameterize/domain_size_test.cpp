#include "stages/parameterize/domain_size.h"

#include <gtest/gtest.h>

namespace lozenge {
namespace {

TEST(DomainSize, KeepsASourceLightThatIsCutAlongIt) {
  for (std::int64_t triangles = 100; triangles < 3'000'000; triangles = triangles * 6 / 5) {
    const FaceRange faces = faces_for_source(triangles);
    EXPECT_GE(faces.least, 4);
    EXPECT_GT(faces.most, faces.least);
    EXPECT_LE(faces.most, 200);
    const auto count = static_cast<double>(triangles);
    const double times = 1 + added_by_cutting(count, faces.most) / count;
    EXPECT_LE(times, triangles >= 50'000 ? 1.5 : triangles >= 2'000 ? 2.5 : 4.0) << triangles;
  }
}

TEST(DomainSize, IsTheOneOfLargeSurfacesFromFiftyThousandTrianglesOn) {
  EXPECT_EQ(faces_for_source(50'000).least, 100);
  EXPECT_EQ(faces_for_source(10'000'000).most, 200);
}

}  // namespace
}  // namespace lozenge
