// Triangles that a surface is better without: those that lie on another one, and those without area that nothing needs.
#pragma once

#include <vector>

#include "formats/surface/repair_report.h"
#include "formats/surface/source_mesh.h"

namespace lozenge {

/// Whether a triangle's corners lie on a line, but for rounding.
bool is_flat(const SourceMesh& mesh, TriangleId t);

/// Leaves out the triangles that aren't kept. \param keep  [triangle]
void leave_out(SourceMesh& mesh, const std::vector<bool>& keep);

/// Leaves out duplicates (duplicates.h). Then those flat
/// triangles that an edge of too many triangles can spare: where, along each of its sides, more triangles run its way
/// than the other way, so that no triangle loses its partner. All other flat triangles stay: they may be what joins two
/// proper triangles, and a triangle without area does less harm than a crack.
void leave_out_superfluous_triangles(SourceMesh& mesh, RepairReport& report);

/// Leaves out pieces all of whose triangles are flat. \pre `mesh` is a manifold with boundary
void leave_out_flat_pieces(SourceMesh& mesh, RepairReport& report);

}  // namespace lozenge
