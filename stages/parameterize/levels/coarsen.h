// A coarser mesh under a map that there is already.
#pragma once

#include <cstdint>
#include <vector>

#include "stages/parameterize/levels/removal.h"
#include "stages/parameterize/map/working_map.h"

namespace lozenge {

/// Removes vertices under a map, until about `triangles` are left: `simplify`, but no image is folded by it, and pinned
/// vertices stay.
std::vector<Removal> coarsen(WorkingMap& map, std::int32_t triangles);

}  // namespace lozenge
