#include "stages/export/vertex_origins.h"

#include <algorithm>

#include "formats/base/parallel.h"
#include "formats/patches/source_level.h"

namespace lozenge {
namespace {

/// The same place by another triangle that has it.
SourcePoint origin_in(const SourceMesh& mesh, const SourcePoint& origin, TriangleId triangle) {
  if (origin.triangle == triangle) return origin;
  SourcePoint same{triangle, Vec3d(0, 0, 0)};
  for (int c = 0; c < 3 && origin.triangle >= 0; ++c) {
    const auto& corners = mesh.triangles[triangle];
    const auto corner = std::find(corners.begin(), corners.end(), mesh.triangles[origin.triangle][c]);
    if (corner != corners.end()) same.weights[static_cast<int>(corner - corners.begin())] = origin.weights[c];
  }
  return same;
}

}  // namespace

SourcePoint origin_at(const SourceMesh& mesh, const ChartedSurface& source, TriangleId triangle, const Vec3d& weights) {
  const ChartedTriangle& t = source.triangles[triangle];
  SourcePoint sum{bent_triangle(t.group), Vec3d(0, 0, 0)};
  if (sum.triangle < 0) return {};
  for (int c = 0; c < 3; ++c) {
    if (weights[c] == 0) continue;
    sum.weights += origin_in(mesh, source.origins[t.corners[c].vertex], sum.triangle).weights * weights[c];
  }
  return sum;
}

std::vector<SourcePoint> origins_of_level(const ChartedSurface& level, const SourceMesh& mesh,
                                          const ChartedSurface& source, const RayScene& scene,
                                          const std::vector<VertexId>& stood_for, const Bodies& bodies) {
  std::vector<std::int32_t> body(level.positions.size(), -1);
  for (const ChartedTriangle& t : level.triangles) {
    for (const ChartedCorner& c : t.corners) body[c.vertex] = bodies.owner_of(t.patch);
  }
  std::vector<SourcePoint> origins(level.positions.size());
  for_each_index(origins.size(), true, [&](std::size_t v) {
    const NearestPoint near = scene.nearest(Vec3d(level.positions[v]));
    const bool is_own = near.exists() && bodies.owner_of(source.triangles[near.triangle].patch) == body[v];
    origins[v] = is_own ? origin_at(mesh, source, near.triangle, near.weights) : source.origins[stood_for[v]];
  });
  return origins;
}

}  // namespace lozenge
