// Sheets: which two triangles go on into each other, where three or more share an edge.
#pragma once

#include <vector>

#include "formats/surface/repair_report.h"
#include "formats/surface/surface_facts.h"

namespace lozenge {

/// [half-edge] its twin, which runs the other way, or `kNoTwin` where the surface shall end. Edges of two triangles
/// that run along it in the same direction are cut. At edges of three or more, partners are found by their angles
/// around the edge: of the pairs that agree on the outside the one that goes on straightest comes first; of two equally
/// straight ones that which encloses the smaller solid angle, so that bodies that touch along an edge come apart.
/// Triangles that remain alone end there.
std::vector<HalfEdge> pair_sheets(const SourceMesh& mesh, const HalfEdgeLinks& links, RepairReport& report);

}  // namespace lozenge
