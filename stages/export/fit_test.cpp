#include "stages/export/fit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "formats/domain/sphere_fixtures.h"
#include "formats/patches/source_level.h"
#include "stages/export/simplify.h"

namespace lozenge {
namespace {

RayScene scene_of(const ChartedSurface& surface) {
  std::vector<std::array<VertexId, 3>> triangles;
  for (const ChartedTriangle& t : surface.triangles) {
    triangles.push_back({t.corners[0].vertex, t.corners[1].vertex, t.corners[2].vertex});
  }
  return {surface.positions, triangles};
}

/// Mean of the squared distances of the middles of triangles to the unit sphere.
double off_the_sphere(const ChartedSurface& surface) {
  double sum = 0;
  double areas = 0;
  for (const ChartedTriangle& t : surface.triangles) {
    const Vec3d a(surface.positions[t.corners[0].vertex]);
    const Vec3d b(surface.positions[t.corners[1].vertex]);
    const Vec3d c(surface.positions[t.corners[2].vertex]);
    const double area = (b - a).cross(c - a).length();
    sum += area * std::pow(((a + b + c) / 3).length() - 1, 2);
    areas += area;
  }
  return sum / areas;
}

TEST(FitToSource, BringsALevelNearerAndGivesItTheSourcesNormals) {
  const auto [mesh, map] = fixtures::subdivided_sphere(fixtures::icosahedron(), 12);
  const PatchLayout patches = patch_layout(mesh, map, 5);
  const MapLayout layout = make_map_layout(patches, 512, 4);
  const ChartedSurface source = source_level(mesh, map, patches, layout);
  const auto charts = chart_scales(layout, patches.size());
  Simplifier simplifier(source, charts, 1e-3);
  simplifier.reduce_to(300);
  ChartedSurface level = simplifier.surface();
  // On the sphere, vertices leave all of their triangles inside; fitted ones stand out.
  for (Vec3f& p : level.positions) p = p.normalized();
  const double before = off_the_sphere(level);
  const auto count = static_cast<std::size_t>(patches.size());
  fit_to_source(level, source, source, scene_of(source),
                {std::vector<std::int32_t>(count, 0), simplifier.slipped_patches()});
  EXPECT_LT(off_the_sphere(level), before / 2);
  for (const ChartedTriangle& t : level.triangles) {
    for (const ChartedCorner& c : t.corners) {
      EXPECT_NEAR(c.carried.length(), 1, 1e-6);
      EXPECT_GT(c.carried.dot(level.positions[c.vertex].normalized()), 0.98);
    }
  }
}

}  // namespace
}  // namespace lozenge
