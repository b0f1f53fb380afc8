// Repair: any welded triangles become an oriented 2-manifold with boundary, by as little as possible.
//
// What is kept is the shape: no vertex moves, and triangles are only left out where they lie on others or have no area
// and no use. What changes is how triangles hang together. In this order:
//
//  - Triangles with the same three vertices as an earlier one, either way round, are left out, and flat ones that an
//  edge
//    of too many triangles can spare (leave_out.h; those with two equal corners went when the mesh was welded).
//  - Triangles are turned over until neighbours agree on the outside; a one-sided surface is cut (orient.h).
//  - Where three or more triangles share an edge, they are paired to sheets (sheets.h).
//  - Fans that share nothing but a vertex get one each (part.h).
//  - Pieces without area go.
//
// T-junctions are joined before (t_junctions.h); other cracks whose two sides have different vertices are boundaries
// like any other.
#pragma once

#include "formats/surface/repair_report.h"
#include "formats/surface/source_mesh.h"

namespace lozenge {

/// Repairs `mesh`, and adds to the report what that took. A mesh that is an oriented 2-manifold with boundary already
/// stays as it is, bit by bit; any other is canonical afterwards. It may have no triangles left.
/// \pre every triangle has three distinct vertices; vertices that share a position are meant to be different ones
void repair_surface(SourceMesh& mesh, RepairReport& report);

}  // namespace lozenge
