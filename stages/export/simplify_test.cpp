#include "stages/export/simplify.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "formats/domain/open_fixtures.h"
#include "formats/domain/sphere_fixtures.h"
#include "formats/patches/source_level.h"
#include "formats/surface/boundary.h"
#include "formats/surface/mesh_statistics.h"
#include "stages/export/thin.h"

namespace lozenge {
namespace {

constexpr double kLeastHeight = 1e-3;

/// A source over the atlas of its map.
struct Charted {
  ChartedSurface surface;
  std::vector<ChartScale> charts;
};

Charted charted(const SourceMesh& mesh, const Parameterization& map) {
  const PatchLayout patches = patch_layout(mesh, map, 5);
  const MapLayout layout = make_map_layout(patches, 512, 4);
  return {source_level(mesh, map, patches, layout), chart_scales(layout, patches.size())};
}

Charted sphere() {
  const auto [mesh, map] = fixtures::subdivided_sphere(fixtures::icosahedron(), 12);
  return charted(mesh, map);
}

std::vector<std::array<VertexId, 3>> triangles_of(const ChartedSurface& surface) {
  std::vector<std::array<VertexId, 3>> triangles;
  for (const ChartedTriangle& t : surface.triangles) {
    triangles.push_back({t.corners[0].vertex, t.corners[1].vertex, t.corners[2].vertex});
  }
  return triangles;
}

TEST(Simplifier, ReachesEachNumberOfTrianglesAndStaysASphere) {
  const Charted source = sphere();
  Simplifier simplifier(source.surface, source.charts, kLeastHeight);
  for (const std::int64_t count : {2000, 700, 250}) {
    simplifier.reduce_to(count);
    const ChartedSurface level = simplifier.surface();
    EXPECT_LE(static_cast<std::int64_t>(level.triangles.size()), count);
    EXPECT_GE(static_cast<std::int64_t>(level.triangles.size()), count - 1) << "a collapse takes two";
    const auto triangles = triangles_of(level);
    const MeshStatistics statistics = mesh_statistics({level.positions, triangles});
    EXPECT_EQ(statistics.euler, 2);
    EXPECT_EQ(statistics.boundary_edges + statistics.tangled_edges + statistics.pinched_vertices, 0);
  }
}

TEST(Simplifier, LetsCornersOfPatchesGoWhereASurfaceIsFlatAndKeepsTrianglesForWhereItIsNot) {
  // The sphere's lower half squeezed flat, all but a bump as large as one of its patches.
  Charted source = sphere();
  for (Vec3f& p : source.surface.positions) {
    if (p.z < 0.6F) p.z = 0.01F * p.z;
  }
  Simplifier simplifier(source.surface, source.charts, kLeastHeight);
  const auto two_a_patch = 2 * static_cast<std::int64_t>(source.charts.size());
  simplifier.reduce_to(two_a_patch);
  EXPECT_EQ(simplifier.triangle_count(), two_a_patch);
  const std::vector<bool>& slipped = simplifier.slipped_patches();
  EXPECT_GT(std::count(slipped.begin(), slipped.end(), true), 0);
  std::map<std::int32_t, int> triangles;
  for (const ChartedTriangle& t : simplifier.surface().triangles) ++triangles[t.patch];
  EXPECT_TRUE(std::any_of(triangles.begin(), triangles.end(), [](const auto& patch) { return patch.second > 3; }));
}

TEST(Simplifier, LeavesPatchesOutWhereFewerTrianglesAreWantedAndTheSurfaceStaysASphere) {
  const Charted source = sphere();
  Simplifier simplifier(source.surface, source.charts, kLeastHeight);
  for (const std::int64_t count : {40, 20, 8, 4, 0}) {
    simplifier.reduce_to(count);
    const ChartedSurface level = simplifier.surface();
    EXPECT_LE(static_cast<std::int64_t>(level.triangles.size()), std::max<std::int64_t>(count, 4)) << "a tetrahedron";
    const auto triangles = triangles_of(level);
    const MeshStatistics statistics = mesh_statistics({level.positions, triangles});
    EXPECT_EQ(statistics.euler, 2);
    EXPECT_EQ(statistics.boundary_edges + statistics.tangled_edges + statistics.pinched_vertices, 0);
    for (const ChartedTriangle& t : level.triangles) {
      const Vec2d a = t.corners[0].place;
      EXPECT_GT((t.corners[1].place - a).cross(t.corners[2].place - a), 0);
    }
  }
  const std::vector<bool>& slipped = simplifier.slipped_patches();
  EXPECT_TRUE(std::all_of(slipped.begin(), slipped.end(), [](bool patch) { return patch; }));
}

TEST(Simplifier, LeavesAPieceWholeThatHasTwoTrianglesOfEachPatchFromTheStart) {
  const auto [mesh, map] = fixtures::subdivided_sphere(fixtures::octahedron(), 1);
  const Charted source = charted(mesh, map);
  ASSERT_EQ(source.surface.triangles.size(), 24U) << "twelve patches";
  Simplifier simplifier(source.surface, source.charts, kLeastHeight);
  simplifier.reduce_to(4);
  EXPECT_EQ(simplifier.triangle_count(), 24);
}

/// Both, the second one much smaller and elsewhere.
Charted with_small_copy(Charted large, const Charted& small, int number) {
  const auto first_vertex = static_cast<VertexId>(large.surface.positions.size());
  const auto first_patch = static_cast<std::int32_t>(large.charts.size());
  const Vec3f middle(3, static_cast<float>(number), 0);
  for (const Vec3f& p : small.surface.positions) large.surface.positions.push_back(middle + p * 0.05F);
  for (ChartedTriangle t : small.surface.triangles) {
    t.patch += first_patch;
    for (ChartedCorner& c : t.corners) c.vertex += first_vertex;
    large.surface.triangles.push_back(t);
  }
  large.charts.insert(large.charts.end(), small.charts.begin(), small.charts.end());
  return large;
}

TEST(Simplifier, TakesFromSmallPiecesThatAreAsSimpleAsTheirPatchesBeforeLargeOnesLoseTheirShape) {
  const auto [mesh, map] = fixtures::subdivided_sphere(fixtures::octahedron(), 1);
  const Charted gem = charted(mesh, map);
  Charted source = sphere();
  const auto patches = static_cast<std::int32_t>(source.charts.size());
  constexpr int kGems = 20;
  for (int i = 0; i < kGems; ++i) source = with_small_copy(std::move(source), gem, i);
  Simplifier simplifier(source.surface, source.charts, kLeastHeight);
  simplifier.reduce_to(200);
  EXPECT_LE(simplifier.triangle_count(), 200);
  int of_sphere = 0;
  for (const ChartedTriangle& t : simplifier.surface().triangles) of_sphere += t.patch < patches ? 1 : 0;
  EXPECT_GE(of_sphere, 200 - 6 * kGems) << "gems are some millionths of all";
}

TEST(Simplifier, KeepsTheLoopsOfASurfaceWhateverItIsLeftWith) {
  for (const fixtures::OpenSurface& open : fixtures::open_surfaces()) {
    const Charted source = charted(open.mesh, open.map);
    Simplifier simplifier(source.surface, source.charts, kLeastHeight);
    simplifier.reduce_to(0);
    const ChartedSurface level = simplifier.surface();
    EXPECT_LE(static_cast<std::int64_t>(level.triangles.size()), 2 * static_cast<std::int64_t>(source.charts.size()))
        << open.name;
    const auto triangles = triangles_of(level);
    const MeshStatistics statistics = mesh_statistics({level.positions, triangles});
    EXPECT_EQ(statistics.euler, open.euler) << open.name;
    EXPECT_EQ(static_cast<int>(boundary_loops(boundary_sides(triangles)).size()), open.loops) << open.name;
    EXPECT_EQ(statistics.tangled_edges + statistics.pinched_vertices, 0) << open.name;
  }
}

TEST(Simplifier, FillsTheSquareOfEachPatchThatHasNotSlippedWithUprightTriangles) {
  const Charted source = sphere();
  Simplifier simplifier(source.surface, source.charts, kLeastHeight);
  simplifier.reduce_to(400);
  std::map<std::int32_t, double> areas;
  for (const ChartedTriangle& t : simplifier.surface().triangles) {
    const Vec2d a = t.corners[0].place;
    const double area = (t.corners[1].place - a).cross(t.corners[2].place - a) / 2;
    EXPECT_GT(area, 0);
    areas[t.patch] += area;
  }
  EXPECT_EQ(areas.size(), source.charts.size());
  // Where a border was drawn through a vertex in the gutter, it comes with its bend: a hundredth of a side here.
  for (const auto& [patch, area] : areas) {
    if (simplifier.slipped_patches()[static_cast<std::size_t>(patch)]) continue;
    EXPECT_NEAR(area, 1, 0.03) << patch;
  }
}

/// The point of a surface at a place of the atlas: that of the patch's triangle that holds it, or is nearest to do so.
Vec3d point_at(const ChartedSurface& surface, std::int32_t patch, const Vec2d& place) {
  Vec3d found(0, 0, 0);
  double deepest = -1e30;
  for (const ChartedTriangle& t : surface.triangles) {
    if (t.patch != patch) continue;
    const Vec2d a = t.corners[0].place - place;
    const Vec2d b = t.corners[1].place - place;
    const Vec2d c = t.corners[2].place - place;
    const Vec3d weights = Vec3d(b.cross(c), c.cross(a), a.cross(b)) / (b - a).cross(c - a);
    const double depth = std::min({weights.x, weights.y, weights.z});
    if (depth <= deepest) continue;
    deepest = depth;
    found = Vec3d(0, 0, 0);
    for (int k = 0; k < 3; ++k) found += Vec3d(surface.positions[t.corners[k].vertex]) * weights[k];
  }
  return found;
}

TEST(Simplifier, LeavesVerticesWhereTheAtlasShowsThem) {
  Charted source = sphere();
  for (Vec3f& p : source.surface.positions) p.z *= 0.01F;  // nearly flat: nothing else holds them
  Simplifier simplifier(source.surface, source.charts, kLeastHeight);
  simplifier.reduce_to(400);
  const ChartedSurface level = simplifier.surface();
  double sum = 0;
  int corners = 0;
  for (const ChartedTriangle& t : level.triangles) {
    if (simplifier.slipped_patches()[static_cast<std::size_t>(t.patch)]) continue;
    for (const ChartedCorner& c : t.corners) {
      sum += (point_at(source.surface, t.patch, c.place) - Vec3d(level.positions[c.vertex])).length();
      ++corners;
    }
  }
  ASSERT_GT(corners, 500);
  EXPECT_LT(sum / corners, 0.01) << "a side of a triangle is about 0.2 long";
}

TEST(Simplifier, KeepsTheLoopsInWhichASurfaceEnds) {
  for (const fixtures::OpenSurface& open : fixtures::open_surfaces()) {
    const Charted source = charted(open.mesh, open.map);
    Simplifier simplifier(source.surface, source.charts, kLeastHeight);
    simplifier.reduce_to(static_cast<std::int64_t>(source.surface.triangles.size()) / 3);
    const ChartedSurface level = simplifier.surface();
    const auto triangles = triangles_of(level);
    EXPECT_EQ(static_cast<int>(boundary_loops(boundary_sides(triangles)).size()), open.loops) << open.name;
    EXPECT_EQ(mesh_statistics({level.positions, triangles}).tangled_edges, 0) << open.name;
  }
}

/// [patch] sides of its triangles that no other triangle of it has.
std::map<std::int32_t, std::int64_t> border_sides(const ChartedSurface& surface) {
  std::map<std::pair<std::int32_t, std::pair<VertexId, VertexId>>, int> triangles;
  for (const ChartedTriangle& t : surface.triangles) {
    for (int k = 0; k < 3; ++k) {
      ++triangles[{t.patch, std::minmax({t.corners[k].vertex, t.corners[(k + 1) % 3].vertex})}];
    }
  }
  std::map<std::int32_t, std::int64_t> sides;
  for (const auto& [side, count] : triangles) sides[side.first] += count == 1 ? 1 : 0;
  return sides;
}

TEST(Thinned, KeepsTrianglesInsideOfPatchesHoweverFineTheirBordersAre) {
  const Charted source = sphere();
  constexpr std::int64_t kShare = 8;
  const auto before = static_cast<std::int64_t>(source.surface.triangles.size());
  const ChartedSurface thin = thinned(source.surface, source.charts, kLeastHeight, before / kShare);
  std::map<std::int32_t, std::int64_t> all;
  std::map<std::int32_t, std::int64_t> left;
  for (const ChartedTriangle& t : source.surface.triangles) ++all[t.patch];
  for (const ChartedTriangle& t : thin.triangles) ++left[t.patch];
  for (const auto& [patch, sides] : border_sides(source.surface)) {
    EXPECT_LE(left[patch], sides + all[patch] / kShare) << "a polygon of them has two triangles less than sides";
    EXPECT_GE(left[patch], sides + all[patch] / kShare - 1) << "a collapse takes two";
  }
}

TEST(Thinned, LeavesBordersAsTheyAreAndTheSurfaceClosed) {
  const Charted source = sphere();
  const auto before = static_cast<std::int64_t>(source.surface.triangles.size());
  const ChartedSurface thin = thinned(source.surface, source.charts, kLeastHeight, before / 8);
  EXPECT_LT(static_cast<std::int64_t>(thin.triangles.size()), before / 2);
  const auto triangles = triangles_of(thin);
  EXPECT_EQ(mesh_statistics({thin.positions, triangles}).boundary_edges, 0);
  const auto on_borders = [](const ChartedSurface& surface) {
    std::map<VertexId, Vec3f> found;
    std::map<VertexId, std::int32_t> patch;
    for (const ChartedTriangle& t : surface.triangles) {
      for (const ChartedCorner& c : t.corners) {
        if (patch.try_emplace(c.vertex, t.patch).first->second != t.patch)
          found[c.vertex] = surface.positions[c.vertex];
      }
    }
    return found;
  };
  EXPECT_EQ(on_borders(thin), on_borders(source.surface));
}

}  // namespace
}  // namespace lozenge
