// Where a surface's outline lies on the screen: distances there are seen, whatever the area around.
#pragma once

#include <array>
#include <vector>

#include "formats/patches/charted_surface.h"

namespace lozenge {

/// An edge that is part of the outline in some views: the surface bends outward there, or ends.
struct OutlineEdge {
  std::int32_t triangle = -1;  ///< one that it is a side of,
  int side = 0;                ///< from this corner to the next
  /// What the outline's normal may be, spread evenly: from one triangle's to the other's, or around the surface's end.
  std::array<Vec3d, 3> normals;
  double weight = 0;  ///< as an area: of all distances along its normals
};

/// Weights are an edge's length, times a width, times the share of views in which the edge is part of the outline: its
/// bend by pi.
/// \param importance  [triangle] weighs its distances \param width  of a strip of surface that counts as much
std::vector<OutlineEdge> outline_edges(const ChartedSurface& surface, const std::vector<float>& importance,
                                       double width);

}  // namespace lozenge
