// T-junctions: a vertex that lies on an edge of another triangle, and is none of its corners.
//
// Voxel editors, CAD programs and modellers leave them where a long edge meets several short ones. The picture is
// closed, the surface is not: both sides are boundaries, and any resampling tears them apart. Joined, the long edge has
// the vertex for a corner of two edges, and what lies on its other side is its neighbour.
#pragma once

#include "formats/surface/repair_report.h"
#include "formats/surface/source_mesh.h"

namespace lozenge {

/// Gives each edge of one triangle the vertices that lie on it, where they belong to an edge of one triangle along it:
/// its triangle becomes several, with attributes interpolated along the edge. No vertex moves. The mesh is canonical
/// afterwards if anything was done. Each vertex that an edge gets is counted. \pre  every triangle has three distinct
/// vertices
void join_t_junctions(SourceMesh& mesh, RepairReport& report);

}  // namespace lozenge
