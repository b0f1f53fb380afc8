// The way back: removed vertices are put back into the mesh and its map, level by level.
#pragma once

#include <vector>

#include "formats/base/progress.h"
#include "stages/parameterize/levels/removal.h"
#include "stages/parameterize/map/working_map.h"

namespace lozenge {

struct RefineOptions {
  double level_growth = 2;  ///< vertices are put back in levels, each this many times the one before
  int sweeps = 4;           ///< of relaxation after the finest level; more after the coarser ones, which cost less
};

/// Puts all removed vertices back, last first, each where it sees its neighbours' images unfolded, and relaxes the map
/// after every level; of a large map the lists of vertices are not kept. \return false where a vertex finds no such
/// place: the way back is blocked, and the map of no use
[[nodiscard]] bool refine(WorkingMap& map, std::vector<Removal> removals, const RefineOptions& options,
                          const Progress& progress);
[[nodiscard]] bool refine(WorkingMap& map, Hierarchy hierarchy, const RefineOptions& options, const Progress& progress);

}  // namespace lozenge
