// Fans: the triangles around a vertex that hang together through edges of that vertex.
#pragma once

#include <vector>

#include "formats/surface/surface_facts.h"

namespace lozenge {

struct Fans {
  std::vector<std::int32_t>
      of_corner;                   ///< [3 * triangle + corner] its fan; numbered in the order of their first corner
  std::vector<VertexId> vertices;  ///< [fan] the vertex that it is around
};

/// \param twins  [half-edge] the one across the edge, which runs the other way; anything negative is a boundary
Fans find_fans(const SourceMesh& mesh, const std::vector<HalfEdge>& twins);

/// Corners of the fan of the vertex that a half-edge leaves.
std::size_t count_fan(const std::vector<HalfEdge>& twins, HalfEdge leaving);

}  // namespace lozenge
