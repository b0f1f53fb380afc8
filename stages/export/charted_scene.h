// A charted surface's triangles by themselves, and ready to be asked.
#pragma once

#include <array>
#include <vector>

#include "formats/patches/charted_surface.h"
#include "formats/surface/ray_scene.h"

namespace lozenge {

/// [triangle] its vertices.
std::vector<std::array<VertexId, 3>> vertices_of(const ChartedSurface& surface);

/// Triangles have the numbers that they have in the surface.
RayScene scene_of(const ChartedSurface& surface);

}  // namespace lozenge
