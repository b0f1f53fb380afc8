// Which sides of the domain may be collapsed (paper, Sec. 5.3).
#pragma once

#include "stages/parameterize/map/working_map.h"

namespace lozenge {

/// The collapse leaves a manifold of the same topology: the link condition, and no vertex with fewer than 3 triangles
/// or more than kMostValence.
bool can_collapse(const WorkingMap& map, DomainSide side);

}  // namespace lozenge
