#include "formats/surface/facing_hits.h"

#include <gtest/gtest.h>

namespace lozenge {
namespace {

/// Squares across the z axis, one triangle of which covers the origin; at these heights, facing up or down.
RayScene layers(const std::vector<std::pair<float, bool>>& sheets) {
  std::vector<Vec3f> positions;
  std::vector<std::array<VertexId, 3>> triangles;
  for (const auto& [z, up] : sheets) {
    const auto first = static_cast<VertexId>(positions.size());
    positions.insert(positions.end(), {{-4, -1, z}, {4, -1, z}, {0, 4, z}});
    if (up) triangles.push_back({first, first + 1, first + 2});
    else triangles.push_back({first, first + 2, first + 1});
  }
  return {positions, triangles};
}

TriangleId seen(const RayScene& scene, const std::function<bool(std::size_t, TriangleId)>& counts) {
  const OrientedPoint point{{0, 0, 0}, {0, 0, 1}};
  RayHit hit;
  facing_hits_through(scene, {&point, 1}, 10, 1e-6, counts, {&hit, 1});
  return hit.triangle;
}

bool all_count(std::size_t, TriangleId) { return true; }

TEST(FacingHitsThrough, SeesWhatFacesTheSameWayBehindWhatDoesNot) {
  // A sheet of some thickness, both of whose sides lie above a point of its upper side's level, over another layer.
  EXPECT_EQ(seen(layers({{2, true}, {1, false}, {-3, true}}), all_count), 0);
}

TEST(FacingHitsThrough, TakesTheNearerOfBothWays) {
  EXPECT_EQ(seen(layers({{3, true}, {-2, true}}), all_count), 1);
  EXPECT_EQ(seen(layers({{1, true}, {-2, true}}), all_count), 0);
}

TEST(FacingHitsThrough, LooksThroughWhatDoesNotCount) {
  const RayScene scene = layers({{1, true}, {2, true}, {-3, true}});
  EXPECT_EQ(seen(scene, [](std::size_t, TriangleId t) { return t != 0; }), 1);
  EXPECT_EQ(seen(scene, [](std::size_t, TriangleId t) { return t == 2; }), 2);
  EXPECT_EQ(seen(scene, [](std::size_t, TriangleId) { return false; }), -1);
}

TEST(FacingHitsThrough, GoesNoFurtherThanTheCage) { EXPECT_EQ(seen(layers({{11, true}, {-12, true}}), all_count), -1); }

}  // namespace
}  // namespace lozenge
