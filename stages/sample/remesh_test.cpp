#include "stages/sample/remesh.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>

#include "formats/base/error.h"
#include "formats/domain/sphere_fixtures.h"
#include "formats/surface/mesh_statistics.h"

namespace lozenge {
namespace {

constexpr std::array kPartitions{Partition::kFaces, Partition::kHalfDiamonds, Partition::kHalfStars};

MeshStatistics facts_of(const SourceMesh& mesh) { return mesh_statistics({mesh.positions, mesh.triangles}); }

TEST(Remesh, IsClosedAndAsRegularAsTheDomainOverEveryPartition) {
  for (const Domain& base : {fixtures::tetrahedron(), fixtures::octahedron(), fixtures::icosahedron()}) {
    auto [mesh, map] = fixtures::subdivided_sphere(base, 8);
    fixtures::jitter(map, 0.02, 3);
    for (const Partition partition : kPartitions) {
      for (const std::int32_t rate : {1, 2, 3, 7, 16}) {
        const SourceMesh result = remesh(mesh, map, {partition, rate});
        const MeshStatistics facts = facts_of(result);
        EXPECT_TRUE(is_closed_manifold(facts)) << "rate " << rate;
        EXPECT_EQ(facts.euler, 2);
        EXPECT_EQ(facts.vertices, static_cast<std::int64_t>(result.positions.size()));
        EXPECT_EQ(facts.irregular_vertices, count_irregular(base));
        const int cells = partition == Partition::kFaces ? 1 : 3;
        EXPECT_EQ(facts.triangles, static_cast<std::int64_t>(cells) * base.size() * rate * rate);
      }
    }
  }
}

TEST(Remesh, LiesOnTheSurface) {
  auto [mesh, map] = fixtures::subdivided_sphere(fixtures::icosahedron(), 20);
  for (const Partition partition : kPartitions) {
    for (const Vec3f& p : remesh(mesh, map, {partition, 9}).positions) EXPECT_NEAR(p.length(), 1, 0.002);
  }
}

TEST(Remesh, HalfStarsAreTheTrianglesOfHalfDiamondsStarByStar) {
  const auto [mesh, map] = fixtures::subdivided_sphere(fixtures::octahedron(), 5);
  for (const std::int32_t rate : {1, 4, 5}) {
    const SourceMesh diamonds = remesh(mesh, map, {Partition::kHalfDiamonds, rate});
    const SourceMesh stars = remesh(mesh, map, {Partition::kHalfStars, rate});
    EXPECT_EQ(diamonds.positions, stars.positions);
    auto a = diamonds.triangles;
    auto b = stars.triangles;
    std::sort(a.begin(), a.end());
    std::sort(b.begin(), b.end());
    EXPECT_EQ(a, b);
    // Every vertex of an octahedron joins four triangles, so a star has four slices; each is a disc.
    const std::size_t per_star = 4 * static_cast<std::size_t>(rate) * rate;
    for (std::size_t first = 0; first < stars.triangles.size(); first += per_star) {
      const MeshStatistics disc =
          mesh_statistics({stars.positions, std::span(stars.triangles).subspan(first, per_star)});
      EXPECT_EQ(disc.euler, 1);
      EXPECT_EQ(disc.boundary_edges, 4 * rate);
    }
  }
}

TEST(Remesh, IsTheSameOnAnyNumberOfThreads) {
  auto [mesh, map] = fixtures::subdivided_sphere(fixtures::icosahedron(), 9);
  for (const Partition partition : kPartitions) {
    const SourceMesh many = remesh(mesh, map, {partition, 11});
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    const SourceMesh alone = remesh(mesh, map, {partition, 11});
    EXPECT_EQ(many.positions, alone.positions);
    EXPECT_EQ(many.triangles, alone.triangles);
  }
}

TEST(Remesh, RefusesRatesThatAreNone) {
  const auto [mesh, map] = fixtures::subdivided_sphere(fixtures::tetrahedron(), 2);
  for (const std::int32_t rate : {-1, 0, kMostRate + 1}) {
    EXPECT_THROW(remesh(mesh, map, {Partition::kFaces, rate}), Error);
    EXPECT_THROW(remesh(mesh, map, {Partition::kHalfStars, rate}), Error);
  }
}

}  // namespace
}  // namespace lozenge
