// Optimizing irregular vertices in their stars (paper, Sec. 5.6).
#pragma once

#include "stages/parameterize/map/checkpoint.h"
#include "stages/parameterize/relax/local_optimization.h"

namespace lozenge {

/// Lets an irregular vertex crawl over the surface (5.6): optimizes its star in the polygon with nothing pinned, takes
/// the source vertex that is nearest to the centre then, and maps back; on the boundary, `crawl`s along it. Refused,
/// and undone, where the true distortion around doesn't fall. \return by how much the energy fell
double optimize_cone(WorkingMap& map, DomainVertex n, const RelaxOptions& options);
/// The same, with the way back in `undo` where it fell.
double optimize_cone(WorkingMap& map, DomainVertex n, const RelaxOptions& options, Checkpoint& undo);

}  // namespace lozenge
