// Cones crawl over the surface: a step along one mesh edge.
//
// A cone lies on a source vertex. Sec. 5.6 lets it move by optimizing its whole star with nothing pinned
// (`optimize_cone`); once the map is good, a cone has no far way to go, and on a fine mesh a star is large. Here it
// moves to one of the neighbours of its vertex, and only what is around is relaxed and judged.
#pragma once

#include <optional>

#include "stages/parameterize/map/local_change.h"
#include "stages/parameterize/map/working_map.h"

namespace lozenge {

/// Moves the cone at `n` to the neighbour where the energy around ends least, if that is less than it was.
/// \return by how much the energy rose, less than 0; nothing, with nothing changed, where no neighbour is better
std::optional<double> crawl(LocalChange& change, DomainVertex n);
std::optional<double> crawl(WorkingMap& map, DomainVertex n, Scratch& scratch);

/// Lets all cones crawl, each until it stays or has gone `most_steps`. \return by how much the energy fell: 0 where all
/// stayed
double crawl_all(WorkingMap& map, int most_steps);

}  // namespace lozenge
