#include "formats/surface/mesh_statistics.h"

#include <gtest/gtest.h>

#include <cmath>

#include "formats/domain/sphere_fixtures.h"

namespace lozenge {
namespace {

using Triangles = std::vector<std::array<VertexId, 3>>;

TEST(MeshStatistics, AreThoseOfAnEquilateralTriangle) {
  const std::vector<Vec3f> positions{{0, 0, 0}, {2, 0, 0}, {1, std::sqrt(3.0F), 0}};
  const Triangles triangles{{0, 1, 2}};
  const MeshStatistics s = mesh_statistics({positions, triangles});
  EXPECT_NEAR(s.area.mean, std::sqrt(3.0), 1e-6);
  EXPECT_NEAR(s.edge.mean, 2, 1e-6);
  EXPECT_NEAR(s.edge.min, 100, 1e-4);
  EXPECT_NEAR(s.edge.max, 100, 1e-4);
  EXPECT_NEAR(s.edge.sigma, 0, 1e-4);
  EXPECT_NEAR(s.min_angle, 3.14159265358979 / 3, 1e-6);
  EXPECT_EQ(s.boundary_edges, 3);
  EXPECT_EQ(s.euler, 1);
}

TEST(MeshStatistics, SpreadIsInPercentOfTheMean) {
  // Areas 1 and 3: mean 2, deviation 1.
  const std::vector<Vec3f> positions{{0, 0, 0}, {2, 0, 0}, {0, 1, 0}, {0, -3, 0}};
  const Triangles triangles{{0, 1, 2}, {1, 0, 3}};
  const Spread area = mesh_statistics({positions, triangles}).area;
  EXPECT_NEAR(area.mean, 2, 1e-9);
  EXPECT_NEAR(area.sigma, 50, 1e-9);
  EXPECT_NEAR(area.min, 50, 1e-9);
  EXPECT_NEAR(area.max, 150, 1e-9);
}

TEST(MeshStatistics, OfSubdividedSpheresKnowTopologyAndCones) {
  for (const Domain& base : {fixtures::tetrahedron(), fixtures::octahedron(), fixtures::icosahedron()}) {
    for (const int n : {1, 2, 5}) {
      const auto [mesh, map] = fixtures::subdivided_sphere(base, n);
      const MeshStatistics s = mesh_statistics({mesh.positions, mesh.triangles});
      EXPECT_TRUE(is_closed_manifold(s));
      EXPECT_EQ(s.euler, 2);
      EXPECT_EQ(s.components, 1);
      EXPECT_EQ(s.vertices, static_cast<std::int64_t>(mesh.positions.size()));
      EXPECT_EQ(s.irregular_vertices, base.vertex_count);
    }
  }
}

TEST(MeshStatistics, ComponentsAddUp) {
  auto [mesh, map] = fixtures::subdivided_sphere(fixtures::octahedron(), 3);
  const auto count = static_cast<VertexId>(mesh.positions.size());
  const Triangles once = mesh.triangles;
  for (const auto& [a, b, c] : once) mesh.triangles.push_back({a + count, b + count, c + count});
  for (VertexId v = 0; v < count; ++v) mesh.positions.push_back(mesh.positions[v] + Vec3f(3, 0, 0));
  const MeshStatistics s = mesh_statistics({mesh.positions, mesh.triangles});
  EXPECT_EQ(s.components, 2);
  EXPECT_EQ(s.euler, 4);
  EXPECT_TRUE(is_closed_manifold(s));
}

TEST(MeshStatistics, SeeAMissingTriangleATurnedOneAndAPinchedVertex) {
  const auto [mesh, map] = fixtures::subdivided_sphere(fixtures::icosahedron(), 2);
  Triangles triangles = mesh.triangles;
  triangles.pop_back();
  EXPECT_EQ(mesh_statistics({mesh.positions, triangles}).boundary_edges, 3);

  triangles = mesh.triangles;
  std::swap(triangles[7][1], triangles[7][2]);
  EXPECT_EQ(mesh_statistics({mesh.positions, triangles}).tangled_edges, 3);

  // Two spheres that share one vertex.
  triangles = mesh.triangles;
  std::vector<Vec3f> positions = mesh.positions;
  const auto count = static_cast<VertexId>(positions.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    const auto moved = [&](VertexId v) { return v == 0 ? 0 : v + count; };
    triangles.push_back({moved(a), moved(b), moved(c)});
  }
  for (VertexId v = 0; v < count; ++v) positions.push_back(positions[v] * 2.0F);
  const MeshStatistics pinched = mesh_statistics({positions, triangles});
  EXPECT_EQ(pinched.pinched_vertices, 1);
  EXPECT_FALSE(is_closed_manifold(pinched));
}

TEST(MeshStatistics, OfNothingAreZero) {
  const MeshStatistics s = mesh_statistics({});
  EXPECT_EQ(s.triangles, 0);
  EXPECT_EQ(s.vertices, 0);
  EXPECT_FALSE(is_closed_manifold(s));
}

}  // namespace
}  // namespace lozenge
