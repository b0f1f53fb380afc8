// Triangles with the same three vertices. Modellers lay one the other way round on another where cloth is to be seen
// from both sides, so what lies so is never left out alone.
#pragma once

#include "formats/surface/repair_report.h"
#include "formats/surface/source_mesh.h"

namespace lozenge {

/// Leaves out of the triangles with the same three vertices the same way round all but the first. Of those the other
/// way round: where one looks like the first, which is to be seen from both sides then, they are left out; where not,
/// the first of them stays, as a layer whose vertices are its own.
void part_duplicates(SourceMesh& mesh, RepairReport& report);

}  // namespace lozenge
