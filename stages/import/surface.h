// What a surface must be before it can be parameterized: an oriented 2-manifold (paper, Sec. 3), perhaps with boundary.
#pragma once

#include <string>
#include <vector>

#include "formats/surface/source_mesh.h"
#include "formats/surface/surface_facts.h"

namespace lozenge {

/// Whether every edge has one triangle, or two that agree on the surface's outside, and the triangles around every
/// vertex form one fan. That is what repair makes (repair.h).
bool is_manifold(const SourceMesh& mesh, const HalfEdgeLinks& links);

/// Proves that the mesh is an oriented 2-manifold with boundary. Several components and any genus are fine.
/// \param file  how messages call the mesh
/// \throws Error(kUnusableInput) where there are no triangles; Error(kUnsupported) elsewhere, naming what breaks,
/// where, how often, and what to do
SurfaceFacts require_manifold(const SourceMesh& mesh, const std::string& file);

}  // namespace lozenge
