// From links between half-edges to vertices: what isn't linked gets vertices of its own.
#pragma once

#include <vector>

#include "formats/surface/repair_report.h"
#include "formats/surface/surface_facts.h"

namespace lozenge {

/// Each fan beyond the first of a vertex gets a vertex of its own, at the same position. \param twins  [half-edge] the
/// one across, which runs the other way, or `kNoTwin` \param links  of the mesh as it is; vertices of no crowded and no
/// cut edge are counted as bow ties
void part_vertices(SourceMesh& mesh, const std::vector<HalfEdge>& twins, const HalfEdgeLinks& links,
                   RepairReport& report);

/// Edges that join the same two vertices and yet are different ones (two sheets that part along an edge and meet again
/// at both of its ends) get a vertex in their middle, all but the first: triangles say by their vertices alone which
/// edges are one. \pre `part_vertices` has been called
void divide_double_edges(SourceMesh& mesh, const std::vector<HalfEdge>& twins, RepairReport& report);

}  // namespace lozenge
