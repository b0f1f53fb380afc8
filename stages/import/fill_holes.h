// Holes: short boundary loops get a cap.
#pragma once

#include "formats/surface/repair_report.h"
#include "formats/surface/source_mesh.h"

namespace lozenge {

/// Caps every boundary loop whose length is at most `percent` of the diagonal of the mesh's box. The result is a
/// manifold again: a cap adds no edge between vertices that have one already; where it would have to, and for loops of
/// more than kMostSidesOfCap edges, it is a fan around a new vertex. A loop whose cap would have
/// four fifths of the area of the piece that it bounds is not a hole but the outline of a flake, and stays.
///
/// Cap triangles get a material of their own, a copy of that which most of the loop has (SourceMesh::cap_of), and the
/// corner attributes of the loop. Where something is filled, the mesh is canonical afterwards.
/// \pre `mesh` is an oriented 2-manifold with boundary
void fill_holes(SourceMesh& mesh, double percent, RepairReport& report);

}  // namespace lozenge
