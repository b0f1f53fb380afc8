// The order of triangles and vertices that SourceMesh promises.
#pragma once

#include <vector>

#include "formats/surface/source_mesh.h"

namespace lozenge {

/// Sorts the triangles by material (stable) and numbers the vertices in the order of their first use; those that no
/// triangle uses go. \return [vertex before] its number now, or -1
std::vector<VertexId> make_canonical(SourceMesh& mesh);
/// The same, with each material's triangles in this order. \param order  every triangle once
std::vector<VertexId> make_canonical(SourceMesh& mesh, std::vector<TriangleId> order);

}  // namespace lozenge
