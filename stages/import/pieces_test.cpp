#include "stages/import/pieces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "stages/import/surface_fixtures.h"

namespace lozenge {
namespace {

using namespace testing_surfaces;

/// Two spheres and a torus, their triangles in random order, with a vertex that none of them uses.
SourceMesh three_pieces(std::uint32_t seed) {
  SourceMesh mesh = joined(joined(sphere(3), torus(4, 5)), sphere(2));
  std::mt19937 random(seed);
  std::shuffle(mesh.triangles.begin(), mesh.triangles.end(), random);
  mesh.positions.emplace_back(0, 0, 0);
  return mesh;
}

TEST(Pieces, AreNamedByTheirLowestVertexInAnyOrderOfTriangles) {
  const auto of_sphere = static_cast<VertexId>(sphere(3).positions.size());
  const auto of_torus = static_cast<VertexId>(torus(4, 5).positions.size());
  for (std::uint32_t seed = 0; seed < 20; ++seed) {
    const SourceMesh mesh = three_pieces(seed);
    const std::vector<VertexId> pieces = pieces_of(mesh);
    const auto last = static_cast<VertexId>(pieces.size()) - 1;
    for (VertexId v = 0; v < last; ++v) {
      EXPECT_EQ(pieces[v], v < of_sphere ? 0 : v < of_sphere + of_torus ? of_sphere : of_sphere + of_torus);
    }
    EXPECT_EQ(pieces[last], last);
  }
}

TEST(Pieces, HaveTheAreasOfTheSurfacesThatTheyAre) {
  const SourceMesh ball = sphere(3);
  const SourceMesh ring = torus(4, 5);
  const std::vector<double> areas = piece_areas(three_pieces(1));
  const std::size_t of_sphere = ball.positions.size();
  // Summed in another order, and the ring's coordinates are rounded where it was moved to.
  EXPECT_NEAR(areas[0], surface_area(ball.positions, ball.triangles), 1e-9);
  EXPECT_EQ(areas[0], areas[of_sphere - 1]);
  EXPECT_NEAR(areas[of_sphere], surface_area(ring.positions, ring.triangles), 1e-4);
  EXPECT_EQ(areas.back(), 0);
}

TEST(Pieces, AreOneWhereTwoSurfacesTouchInAVertex) {
  SourceMesh mesh = joined(sphere(1), sphere(1));
  const auto half = static_cast<VertexId>(mesh.positions.size() / 2);
  for (auto& triangle : mesh.triangles) std::replace(triangle.begin(), triangle.end(), half, VertexId{0});
  const std::vector<VertexId> pieces = pieces_of(mesh);
  for (VertexId v = 0; v < 2 * half; ++v) EXPECT_EQ(pieces[v], v == half ? half : 0);
}

}  // namespace
}  // namespace lozenge
