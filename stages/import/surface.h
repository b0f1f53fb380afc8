// What a surface must be before it can be parameterized: closed, oriented, 2-manifold (paper, Sec. 3).
#pragma once

#include <string>

#include "formats/source_mesh.h"
#include "formats/surface_facts.h"

namespace lozenge {

/// Proves that every edge joins exactly two triangles that agree on the surface's outside, and that the triangles
/// around every vertex form one fan. Several components and any genus are fine. \param file  how messages call the mesh
/// \throws Error(kUnusableInput) where there are no triangles; Error(kUnsupported) elsewhere, naming what breaks,
/// where,
///         how often, and what to do
SurfaceFacts require_closed_surface(const SourceMesh& mesh, const std::string& file);

}  // namespace lozenge
