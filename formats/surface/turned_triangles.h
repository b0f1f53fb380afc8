// Triangles that are folded over, in space.
#pragma once

#include <vector>

#include "formats/surface/surface_view.h"

namespace lozenge {

/// The triangles that face nearly the opposite way of each of their neighbours, where they have two at least:
/// ascending. Edges may be sharp, but no surface turns back and forth at one triangle.
///
/// \param surface       triangles that hang together share vertices
/// \param least_height  triangles that are less high face no way: what rounding makes of them means nothing
std::vector<TriangleId> turned_triangles(const SurfaceView& surface, double least_height = 0);

}  // namespace lozenge
