// Which side of each triangle is outside: neighbours are made to agree.
#pragma once

#include "formats/surface/repair_report.h"
#include "formats/surface/source_mesh.h"

namespace lozenge {

/// Turns triangles over until neighbours across edges of exactly two triangles agree. In each patch that such edges
/// hold together the side that has more area keeps its orientation;
/// but where neither has two thirds and the patch is closed, all turn to enclose a positive volume. A one-sided patch
/// (a Moebius strip, a Klein bottle) can't agree everywhere: breadth-first from its first triangle, so the disagreement
/// ends up far from there and across a short way, it is left with edges whose two triangles still run along them in the
/// same direction. Corner normals that pointed out of a turned triangle's old outside are negated. \pre all triangles
/// have three distinct vertices
void orient_patches(SourceMesh& mesh, RepairReport& report);

}  // namespace lozenge
