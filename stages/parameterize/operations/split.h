// Edge splits on the abstract domain: a vertex of four triangles more. What a collapse takes away in one place can be
// given to another.
#pragma once

#include "stages/parameterize/map/checkpoint.h"
#include "stages/parameterize/map/working_map.h"
#include "stages/parameterize/relax/local_optimization.h"

namespace lozenge {

/// There is room for two more triangles and a vertex (what collapses have left), and for one more triangle around both
/// vertices opposite.
bool can_split(const WorkingMap& map, DomainSide side);

/// Splits the side and carries every vertex at home in its two triangles along, through the star of the new vertex. The
/// way back is in `undo`; `rise` is by how much the energy around is higher than it was (less than 0 where it is
/// lower), both with the scale of the larger domain. \pre can_split \return the new vertex, or -1, with nothing
/// changed, where every centre that was tried leaves a fold
DomainVertex split(WorkingMap& map, DomainSide side, const RelaxOptions& options, Checkpoint& undo, double& rise);

}  // namespace lozenge
