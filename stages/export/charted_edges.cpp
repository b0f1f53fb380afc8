#include "stages/export/charted_edges.h"

#include <algorithm>

namespace lozenge {

std::vector<ChartedSide> sides_by_edge(const ChartedSurface& surface) {
  std::vector<ChartedSide> sides;
  sides.reserve(3 * surface.triangles.size());
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    for (int c = 0; c < 3; ++c) {
      const VertexId a = surface.triangles[t].corners[c].vertex;
      const VertexId b = surface.triangles[t].corners[(c + 1) % 3].vertex;
      sides.push_back({{std::min(a, b), std::max(a, b)}, static_cast<TriangleId>(t), c});
    }
  }
  std::stable_sort(sides.begin(), sides.end(),
                   [](const ChartedSide& a, const ChartedSide& b) { return a.ends < b.ends; });
  return sides;
}

}  // namespace lozenge
