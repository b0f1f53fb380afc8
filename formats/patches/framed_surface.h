// A charted surface as a renderer gets it: vertices with tangent frames, each with one texture coordinate and one
// normal.
#pragma once

#include <cstdint>
#include <vector>

#include "formats/patches/charted_surface.h"
#include "formats/patches/tangent_frame.h"

namespace lozenge {

struct FramedSurface {
  std::vector<FrameVertex> vertices;
  std::vector<VertexId> positions;     ///< [vertex] of ChartedSurface::positions
  std::vector<std::uint32_t> indices;  ///< [3 * triangle of the charted surface + corner]
};

/// Corners are one vertex where all of vertex, texture coordinates and normal agree by bits; tangents are those of the
/// atlas's texture coordinates (`vertex_tangents`). Vertices are numbered as triangles first use them.
/// \pre what corners carry are unit normals
FramedSurface framed_surface(const ChartedSurface& surface, const MapLayout& layout);

}  // namespace lozenge
