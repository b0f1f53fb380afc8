#include "formats/surface/turned_triangles.h"

#include <gtest/gtest.h>

#include <array>
#include <vector>

namespace lozenge {
namespace {

/// A triangle with one on each side, all in a plane; the tip of the first side's lies at `tip`.
struct Star {
  std::vector<Vec3f> positions{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.5F, -1, 0}, {1, 1, 0}, {-1, 0.5F, 0}};
  std::vector<std::array<VertexId, 3>> triangles{{0, 1, 2}, {1, 0, 3}, {2, 1, 4}, {0, 2, 5}};
};

TEST(TurnedTriangles, AreNoneInAPlane) {
  const Star star;
  EXPECT_TRUE(turned_triangles({star.positions, star.triangles}).empty());
}

TEST(TurnedTriangles, FaceTheOtherWayThanAllTheirNeighbours) {
  Star star;
  // Two corners changed their places: the middle one faces down, and the others still up.
  star.positions[3] = {0.5F, 0.5F, 0};
  star.positions[4] = {-0.5F, -0.5F, 0};
  star.positions[5] = {2, 0.5F, 0};
  EXPECT_EQ(turned_triangles({star.positions, star.triangles}), std::vector<TriangleId>{0});
}

TEST(TurnedTriangles, ArentThoseThatAreLessHighThanRounding) {
  Star star;
  star.positions = {{0, 0, 0}, {1, 0, 0}, {0.5F, 1e-6F, 0}, {0.5F, 0.5F, 0}, {-0.5F, -0.5F, 0}, {2, -0.5F, 0}};
  EXPECT_EQ(turned_triangles({star.positions, star.triangles}).size(), 1U);
  EXPECT_TRUE(turned_triangles({star.positions, star.triangles}, 1e-5).empty());
}

TEST(TurnedTriangles, ArentThoseAtAnEdgeThatIsSharp) {
  Star star;
  star.positions[3] = {0.5F, 0.5F, 0.01F};  // one neighbour is folded back over the middle one
  EXPECT_TRUE(turned_triangles({star.positions, star.triangles}).empty());
}

}  // namespace
}  // namespace lozenge
