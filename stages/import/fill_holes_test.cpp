#include "stages/import/fill_holes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "formats/surface/attribute_fixtures.h"
#include "formats/surface/canonical_form.h"
#include "stages/import/cap_polygon.h"
#include "stages/import/surface.h"
#include "stages/import/surface_fixtures.h"

namespace lozenge {
namespace {

using namespace testing_surfaces;

/// A sphere without the triangles that have a corner above this height.
SourceMesh cup(int n, float height) {
  SourceMesh mesh = sphere(n);
  std::erase_if(mesh.triangles, [&](const auto& triangle) {
    return std::any_of(triangle.begin(), triangle.end(), [&](VertexId v) { return mesh.positions[v].z > height; });
  });
  make_canonical(mesh);
  return mesh;
}

double area_of(const SourceMesh& mesh, bool caps) {
  double area = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (is_cap(mesh, static_cast<TriangleId>(t)) != caps) continue;
    area += triangle_area(mesh.positions, mesh.triangles[t]);
  }
  return area;
}

TEST(FillHoles, ClosesAHoleOfAnyNumberOfSides) {
  // The ring at the height of the cut has 4 i edges; beyond kMostSidesOfCap the cap is a fan.
  for (const int n : {2, 3, 8, 20, 40, 60}) {
    SourceMesh mesh = cup(n, 0.3F);
    const SurfaceFacts before = require_manifold(mesh, "cup");
    ASSERT_EQ(before.boundary_loops, 1);
    RepairReport report;
    fill_holes(mesh, 1000, report);
    EXPECT_EQ(report[RepairKind::kFilledHoles].count, 1);
    const SurfaceFacts after = require_manifold(mesh, "cup");
    EXPECT_EQ(after.euler, 2);
    EXPECT_EQ(after.boundary_edges, 0);
    const bool fan = static_cast<std::size_t>(before.boundary_edges) > kMostSidesOfCap;
    EXPECT_EQ(after.vertices, before.vertices + (fan ? 1 : 0));
    EXPECT_EQ(after.triangles, before.triangles + before.boundary_edges - (fan ? 0 : 2));
    // No more than the disc that the hole is, which is at most the unit disc.
    EXPECT_LT(area_of(mesh, true), 3.15);
    EXPECT_GT(area_of(mesh, true), 0.5);
  }
}

TEST(FillHoles, LeavesLongerLoopsOpenAndTheMeshAsItIs) {
  SourceMesh mesh = cup(8, 0.3F);
  const SourceMesh before = mesh;
  RepairReport report;
  fill_holes(mesh, 50, report);
  fill_holes(mesh, 0, report);
  EXPECT_TRUE(report.none());
  EXPECT_EQ(mesh.triangles, before.triangles);
  EXPECT_TRUE(mesh.cap_of.empty());
}

TEST(FillHoles, LeavesFlakesOpenWhoseOutlineIsNoHole) {
  SourceMesh flake;
  flake.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  flake.triangles = {{0, 1, 2}, {0, 2, 3}};
  RepairReport report;
  fill_holes(flake, 1000, report);
  flake.triangles.pop_back();
  flake.positions.pop_back();
  fill_holes(flake, 1000, report);
  EXPECT_TRUE(report.none());
}

TEST(FillHoles, AddsNoEdgeBetweenVerticesThatHaveOne) {
  // On surfaces of so few triangles most diagonals of a hole are edges elsewhere.
  std::mt19937 random(1);
  for (int i = 0; i < 300; ++i) {
    SourceMesh mesh = i % 2 == 0 ? fixtures::subdivided_sphere(fixtures::tetrahedron(), 1 + i % 3).first : torus(3, 3);
    for (std::size_t k = 1 + random() % 5; k > 0 && mesh.triangles.size() > 2; --k) {
      mesh.triangles.erase(mesh.triangles.begin() + static_cast<long>(random() % mesh.triangles.size()));
    }
    make_canonical(mesh);
    if (!is_manifold(mesh, link_half_edges(mesh))) continue;
    RepairReport report;
    fill_holes(mesh, 10000, report);
    EXPECT_NO_THROW(require_manifold(mesh, "mesh"));
  }
}

TEST(FillHoles, MarksCapsByAMaterialOfTheirOwnAndGivesThemTheLoopsAttributes) {
  for (const bool with_materials : {false, true}) {
    SourceMesh mesh = cup(6, 0.4F);
    if (with_materials) {
      mesh.material_names = {"unused", "stone"};
      mesh.materials.assign(mesh.triangles.size(), 1);
      mesh.double_sided = {false, true};
    }
    for (std::size_t c = 0; c < 3 * mesh.triangles.size(); ++c) {
      const Vec3f& p = mesh.positions[mesh.triangles[c / 3][c % 3]];
      fixtures::add_corner(mesh, kNormals, p.normalized());
      fixtures::add_corner(mesh, kTextureCoordinates, Vec2f(p.x, p.y));
      fixtures::add_corner(mesh, kColors, Vec4f(0.25F, 0.5F, 0.75F, 1));
    }
    const std::size_t before = mesh.triangles.size();
    RepairReport report;
    fill_holes(mesh, 1000, report);
    ASSERT_GT(mesh.triangles.size(), before);
    ASSERT_EQ(mesh.materials.size(), mesh.triangles.size());
    ASSERT_EQ(mesh.cap_of.size(), mesh.material_names.size());
    EXPECT_EQ(mesh.double_sided, with_materials ? std::vector<bool>({false, true, true}) : std::vector<bool>());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      EXPECT_EQ(is_cap(mesh, static_cast<TriangleId>(t)), t >= before);
      EXPECT_EQ(mesh.material_names[mesh.materials[t]],
                std::string(t >= before ? "cap of " : "") + (with_materials ? "stone" : "default"));
      for (std::size_t c = 3 * t; c < 3 * t + 3; ++c) {
        const Vec3f& p = mesh.positions[mesh.triangles[t][c % 3]];
        EXPECT_EQ(fixtures::corner_uvs(mesh)[c], Vec2f(p.x, p.y));
        EXPECT_EQ(fixtures::corner_colors(mesh)[c], Vec4f(0.25F, 0.5F, 0.75F, 1));
      }
    }
  }
}

TEST(CapPolygon, CoversAPlanePolygonOnce) {
  // An L, whose area only triangulations inside of it have.
  const std::vector<Vec3d> corners{{0, 0, 0}, {3, 0, 0}, {3, 1, 0}, {1, 1, 0}, {1, 3, 0}, {0, 3, 0}};
  const auto cap = cap_polygon(corners, [](int, int) { return true; });
  ASSERT_TRUE(cap);
  EXPECT_EQ(cap->triangles.size(), 4U);
  EXPECT_NEAR(cap->area, 5, 1e-12);
}

TEST(CapPolygon, TakesNoForbiddenDiagonalAndSaysWhereThereIsNoOther) {
  const std::vector<Vec3d> square{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  const auto cap = cap_polygon(square, [](int i, int k) { return i != 0 || k != 2; });
  ASSERT_TRUE(cap);
  for (const auto& [a, b, c] : cap->triangles) EXPECT_TRUE(a == 1 || b == 1 || c == 1) << a << b << c;
  EXPECT_FALSE(cap_polygon(square, [](int, int) { return false; }));
}

}  // namespace
}  // namespace lozenge
