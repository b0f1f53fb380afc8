#include "formats/surface/boundary.h"

#include <gtest/gtest.h>

#include "formats/domain/open_fixtures.h"
#include "formats/domain/sphere_fixtures.h"
#include "formats/surface/mesh_statistics.h"

namespace lozenge {
namespace {

SurfaceView view(const SourceMesh& mesh) { return {mesh.positions, mesh.triangles}; }

TEST(Boundary, OfAClosedSurfaceIsEmpty) {
  const SourceMesh mesh = fixtures::subdivided_sphere(fixtures::octahedron(), 5).first;
  EXPECT_TRUE(boundary_sides(view(mesh)).empty());
  EXPECT_TRUE(boundary_loops({}).empty());
}

TEST(Boundary, HasTheSidesThatStatisticsCountInAsManyLoopsAsTheSurfaceHasHoles) {
  for (const fixtures::OpenSurface& open : fixtures::open_surfaces()) {
    const std::vector<BoundarySide> sides = boundary_sides(view(open.mesh));
    EXPECT_EQ(static_cast<std::int64_t>(sides.size()), mesh_statistics(view(open.mesh)).boundary_edges) << open.name;
    const auto loops = boundary_loops(sides);
    EXPECT_EQ(static_cast<int>(loops.size()), open.loops) << open.name;
    std::size_t vertices = 0;
    for (const auto& loop : loops) {
      vertices += loop.size();
      for (std::size_t k = 0; k < loop.size(); ++k) {
        const BoundarySide side{loop[k], loop[(k + 1) % loop.size()]};
        EXPECT_TRUE(std::binary_search(sides.begin(), sides.end(), side)) << open.name;
      }
    }
    EXPECT_EQ(vertices, sides.size()) << open.name;
  }
}

TEST(Boundary, SidesAreRepeatedWhereATriangleIsThereTwiceOrTurnedAgainstItsNeighbour) {
  const std::vector<std::array<VertexId, 3>> square{{0, 1, 2}, {0, 2, 3}};
  EXPECT_FALSE(has_repeated_sides(square));
  EXPECT_FALSE(has_repeated_sides({}));
  EXPECT_TRUE(has_repeated_sides(std::vector<std::array<VertexId, 3>>{{0, 1, 2}, {2, 0, 1}}));
  EXPECT_TRUE(has_repeated_sides(std::vector<std::array<VertexId, 3>>{{0, 1, 2}, {2, 0, 3}, {3, 2, 0}}));
  EXPECT_TRUE(has_repeated_sides(std::vector<std::array<VertexId, 3>>{{0, 1, 2}, {2, 3, 0}, {1, 2, 4}}));
}

TEST(Boundary, RunsWithTheSurfaceOnItsLeft) {
  const std::vector<Vec3f> positions{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const std::vector<std::array<VertexId, 3>> triangles{{1, 2, 0}};
  EXPECT_EQ(boundary_loops(boundary_sides({positions, triangles})), (std::vector<std::vector<VertexId>>{{0, 1, 2}}));
}

TEST(Boundary, DoesNotRunBetweenVerticesOfEqualBits) {
  // A square whose two triangles have vertices of their own.
  const std::vector<Vec3f> positions{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  const std::vector<std::array<VertexId, 3>> triangles{{0, 1, 2}, {3, 4, 5}};
  EXPECT_EQ(boundary_loops(boundary_sides({positions, triangles})), (std::vector<std::vector<VertexId>>{{0, 1, 2, 5}}));
  // By their numbers each triangle ends on its own.
  EXPECT_EQ(boundary_loops(boundary_sides(triangles)).size(), 2U);
}

TEST(Boundary, WeldsVerticesToTheLowestOfEqualBits) {
  const std::vector<Vec3f> positions{{1, 0, 0}, {0, 0, 0}, {1, 0, 0}, {-0.0F, 0, 0}, {0, 0, 0}, {1, 0, 0}};
  EXPECT_EQ(welded_vertices(positions), (std::vector<VertexId>{0, 1, 0, 3, 1, 0}));
  EXPECT_EQ(renumbered({{2, 4, 3}}, welded_vertices(positions)), (std::vector<std::array<VertexId, 3>>{{0, 1, 3}}));
}

TEST(Boundary, GivesEverySideOnceWhereTwoLoopsShareAVertexOrSidesDontChain) {
  const std::vector<Vec3f> positions{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}};
  for (const std::array<VertexId, 3>& second : {std::array<VertexId, 3>{0, 3, 4}, std::array<VertexId, 3>{0, 4, 3}}) {
    for (const std::array<VertexId, 3>& first : {std::array<VertexId, 3>{0, 1, 2}, std::array<VertexId, 3>{0, 2, 1}}) {
      const std::vector<std::array<VertexId, 3>> triangles{first, second};
      std::size_t vertices = 0;
      for (const auto& loop : boundary_loops(boundary_sides({positions, triangles}))) vertices += loop.size();
      EXPECT_EQ(vertices, 6U);
    }
  }
}

}  // namespace
}  // namespace lozenge
