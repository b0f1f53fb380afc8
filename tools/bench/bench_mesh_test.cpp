#include "tools/bench/bench_mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "formats/base/error.h"
#include "formats/surface/mesh_statistics.h"
#include "tools/bench/mesh_file.h"

namespace lozenge::bench {
namespace {

double volume(const Surface& mesh) {
  double six_times = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    six_times += Vec3d(mesh.positions[a]).dot(Vec3d(mesh.positions[b]).cross(Vec3d(mesh.positions[c])));
  }
  return six_times / 6;
}

double area(const Surface& mesh) {
  const MeshStatistics s = mesh_statistics(mesh.view());
  return s.area.mean * static_cast<double>(s.triangles);
}

bool same(const Surface& a, const Surface& b) { return a.positions == b.positions && a.triangles == b.triangles; }

TEST(FormulaMeshes, AreClosedFaceOutwardAndAreAboutAsLargeAsAsked) {
  for (const int triangles : {20, 100, 1000, 20000}) {
    const Surface sphere = sphere_mesh(triangles);
    const Surface torus = torus_mesh(triangles);
    for (const Surface& mesh : {sphere, torus}) {
      EXPECT_TRUE(is_closed_manifold(mesh_statistics(mesh.view()))) << triangles;
      EXPECT_GT(volume(mesh), 0) << triangles;
      EXPECT_GT(static_cast<double>(mesh.triangles.size()), 0.7 * triangles);
      EXPECT_LT(static_cast<double>(mesh.triangles.size()), 1.3 * triangles);
    }
    EXPECT_EQ(mesh_statistics(sphere.view()).euler, 2);
    EXPECT_EQ(mesh_statistics(torus.view()).euler, 0);
  }
}

TEST(Subdivided, HasFourTimesTheTrianglesOfTheSameSurface) {
  const Surface mesh = sphere_mesh(500);
  const Surface fine = subdivided(mesh, 2, 0, 1);
  EXPECT_EQ(fine.triangles.size(), 16 * mesh.triangles.size());
  EXPECT_TRUE(is_closed_manifold(mesh_statistics(fine.view())));
  EXPECT_NEAR(volume(fine), volume(mesh), 1e-5);
  EXPECT_TRUE(same(subdivided(mesh, 0, 0.1, 1), mesh));
}

TEST(Subdivided, NoiseRoughensAndLeavesTheSurfaceWhereItIs) {
  const Surface mesh = torus_mesh(2000);
  const MeshStatistics before = mesh_statistics(mesh.view());
  double last_area = area(mesh) * (1 + 1e-6);
  for (const double noise : {0.02, 0.1, 1.0}) {
    const Surface fine = subdivided(mesh, 3, noise, 1);
    const MeshStatistics after = mesh_statistics(fine.view());
    EXPECT_TRUE(is_closed_manifold(after));
    // Displacements halve from level to level; their sum is below twice the first, and half of them go inwards.
    EXPECT_NEAR(volume(fine) / volume(mesh), 1, 0.01);
    EXPECT_GT(after.min_angle, before.min_angle / 3);
    // Out of the plane every triangle grows.
    EXPECT_GT(area(fine), last_area);
    last_area = area(fine);
  }
}

TEST(Subdivided, IsTheSameForTheSameSeedAlone) {
  const Surface mesh = sphere_mesh(500);
  EXPECT_TRUE(same(subdivided(mesh, 1, 0.1, 1), subdivided(mesh, 1, 0.1, 1)));
  EXPECT_FALSE(same(subdivided(mesh, 1, 0.1, 1), subdivided(mesh, 1, 0.1, 2)));
}

TEST(Subdivided, RefusesTrianglesWithoutArea) {
  const Surface flat{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}}};
  EXPECT_THROW(subdivided(flat, 1, 0.1, 1), Error);
}

TEST(Subdivided, RefusesToGoBelowWhatFloatsResolve) {
  Surface far = sphere_mesh(20);
  for (Vec3f& p : far.positions) p += Vec3f(1e6F, 1e6F, 1e6F);
  EXPECT_THROW(subdivided(welded(far), 6, 0.1, 1), Error);
}

TEST(Uneven, HasThinTrianglesOfVeryDifferentSizesOnTheSameSurface) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    const Surface mesh = torus_mesh(20000);
    const Surface made = uneven(mesh, seed);
    const MeshStatistics s = mesh_statistics(made.view());
    EXPECT_TRUE(is_closed_manifold(s));
    EXPECT_EQ(s.euler, 0);
    EXPECT_LT(static_cast<double>(made.triangles.size()), 0.45 * static_cast<double>(mesh.triangles.size()));
    EXPECT_GT(s.area.max / s.area.min, 100);
    // An even mesh has some 40 degrees.
    EXPECT_LT(s.mean_min_angle, 25 * std::numbers::pi / 180);
    EXPECT_NEAR(volume(made) / volume(mesh), 1, 0.02);
    // Vertices stay where they were, and the surface between them near the ring.
    for (const auto& [a, b, c] : made.triangles) {
      const Vec3d p = (Vec3d(made.positions[a]) + Vec3d(made.positions[b]) + Vec3d(made.positions[c])) / 3.0;
      EXPECT_NEAR(std::hypot(std::hypot(p.x, p.y) - 1, p.z), 0.4, 0.04);
    }
  }
}

TEST(Uneven, IsTheSameForTheSameSeedAlone) {
  const Surface mesh = sphere_mesh(2000);
  EXPECT_TRUE(same(uneven(mesh, 5), uneven(mesh, 5)));
  EXPECT_FALSE(same(uneven(mesh, 5), uneven(mesh, 6)));
}

TEST(Uneven, LeavesAloneWhatCannotLoseAVertex) {
  const Surface tetrahedron{{{1, 1, 1}, {-1, -1, 1}, {-1, 1, -1}, {1, -1, -1}},
                            {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
  EXPECT_EQ(uneven(tetrahedron, 1).triangles.size(), 4U);
}

TEST(Uneven, RefusesOpenSurfaces) {
  Surface open = sphere_mesh(100);
  open.triangles.pop_back();
  try {
    uneven(open, 1);
    FAIL() << "nothing was thrown";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::kUnsupported);
  }
}

}  // namespace
}  // namespace lozenge::bench
