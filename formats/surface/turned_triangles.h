// Triangles that are folded over, in space.
#pragma once

#include <vector>

#include "formats/surface/surface_view.h"

namespace lozenge {

/// The triangles that face nearly the opposite way of each of their neighbours, where they have two at least:
/// ascending. Edges may be sharp, but no surface turns back and forth at one triangle. \pre triangles that hang
/// together share vertices
std::vector<TriangleId> turned_triangles(const SurfaceView& surface);

}  // namespace lozenge
