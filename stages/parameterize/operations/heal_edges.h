// Edges of the domain whose paths on the surface are too long are flipped (paper, Sec. 5.4).
#pragma once

#include "stages/parameterize/map/path_lengths.h"
#include "stages/parameterize/map/scratch.h"
#include "stages/parameterize/map/working_map.h"

namespace lozenge {

/// Flips with a positive gain (paper, eq. 3), the biggest first. \return how many were done
int heal_overlong_edges(WorkingMap& map, const SurfaceMeasures& measures, Scratch& scratch);

}  // namespace lozenge
