// The pieces of a mesh: triangles hang together where they share a vertex.
#pragma once

#include <vector>

#include "formats/surface/source_mesh.h"

namespace lozenge {

/// [vertex] the lowest vertex of the piece that it belongs to: itself where no triangle uses it.
std::vector<VertexId> pieces_of(const SourceMesh& mesh);

/// [vertex] the area of the piece that it belongs to.
std::vector<double> piece_areas(const SourceMesh& mesh);

}  // namespace lozenge
