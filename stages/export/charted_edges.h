// The edges of a charted surface, each with the triangles that have it.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "formats/patches/charted_surface.h"

namespace lozenge {

/// A triangle's side, from this corner to the next.
struct ChartedSide {
  std::array<VertexId, 2> ends{-1, -1};  ///< the lower vertex first
  TriangleId triangle = -1;
  int corner = -1;
};

/// Sides sorted by edge, those of an edge by triangle.
std::vector<ChartedSide> sides_by_edge(const ChartedSurface& surface);

/// Calls `visit(sides)` with those of each edge, in the order of edges: two where the surface goes on, one at its end.
template <typename Visit>
void for_each_edge(const std::vector<ChartedSide>& sides, const Visit& visit) {
  for (std::size_t first = 0, end = 0; first < sides.size(); first = end) {
    while (end < sides.size() && sides[end].ends == sides[first].ends) ++end;
    visit(std::span(sides).subspan(first, end - first));
  }
}

}  // namespace lozenge
