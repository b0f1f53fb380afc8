// Simplification of large meshes, on all threads.
#pragma once

#include <cstdint>
#include <vector>

#include "stages/parameterize/levels/removal.h"

namespace lozenge {

/// `simplify` of a large mesh on all threads: first in blocks, down to the edges that the proxy has, then in others,
/// for what lies where those met, then as a whole. \param keep  vertices that are not removed
Hierarchy simplify_in_blocks(HalfedgeMesh& mesh, const std::vector<Vec3f>& positions, std::int32_t triangles,
                             const std::vector<VertexId>& keep = {});

}  // namespace lozenge
