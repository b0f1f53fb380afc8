// Cones crawl over the surface: a step along one mesh edge.
//
// A cone lies on a source vertex. Sec. 5.6 lets it move by optimizing its whole star with nothing pinned
// (`optimize_cone`); once the map is good, a cone has no far way to go, and on a fine mesh a star is large. Here it
// moves to one of the neighbours of its vertex, and only what is around is relaxed and judged.
#pragma once

#include "stages/parameterize/map/checkpoint.h"
#include "stages/parameterize/map/working_map.h"

namespace lozenge {

/// Moves the cone at `n` to the neighbour where the energy around ends least, if that is less than it was.
/// \return by how much the energy fell: 0, and nothing changed, where no neighbour is better
double crawl(WorkingMap& map, DomainVertex n);
/// The same, with the way back in `undo` where it fell.
double crawl(WorkingMap& map, DomainVertex n, Checkpoint& undo);

/// Lets all cones crawl, each until it stays or has gone `most_steps`. \return by how much the energy fell: 0 where all
/// stayed
double crawl_all(WorkingMap& map, int most_steps);

}  // namespace lozenge
