#include "stages/export/charted_scene.h"

namespace lozenge {

std::vector<std::array<VertexId, 3>> vertices_of(const ChartedSurface& surface) {
  std::vector<std::array<VertexId, 3>> triangles;
  triangles.reserve(surface.triangles.size());
  for (const ChartedTriangle& t : surface.triangles) {
    triangles.push_back({t.corners[0].vertex, t.corners[1].vertex, t.corners[2].vertex});
  }
  return triangles;
}

RayScene scene_of(const ChartedSurface& surface) { return {surface.positions, vertices_of(surface)}; }

}  // namespace lozenge
