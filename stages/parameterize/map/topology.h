// What a surface's topology asks of its domain.
#pragma once

#include <cstdint>

#include "stages/parameterize/map/halfedge_mesh.h"

namespace lozenge {

/// Of a connected surface.
struct Topology {
  std::int64_t genus = 0;
  std::int64_t loops = 0;  ///< in which it ends
};

/// \pre the mesh is connected
Topology topology_of(const HalfedgeMesh& mesh);

/// A lower bound of the number of triangles of any domain that such a surface can have. A loop closed by one vertex
/// more gives a closed surface, whose triangulations have at least (7 + sqrt(1 + 48 g)) / 2 vertices (Heawood's bound;
/// 10 for g = 2), and loops, of three sides at least, share no vertices.
std::int32_t least_domain_faces(const Topology& topology);

}  // namespace lozenge
