// Relaxing the whole map on all threads (paper, Sec. 5.5).
//
// The vertices are parted into blocks of near neighbours. Those whose neighbours all are in their own block move block
// by block, on as many threads as there are; those between blocks are coloured so that no two neighbours share a
// colour, and move colour by colour. Blocks and colours depend on the map alone, so the result is the same on any
// number of threads.
#pragma once

#include <vector>

#include "stages/parameterize/map/working_map.h"
#include "stages/parameterize/relax/local_optimization.h"

namespace lozenge {

/// Sweeps over all vertices. \return by how much the energy fell
double relax_all(WorkingMap& map, const RelaxOptions& options);

/// Whatever moved straight from where it was `before` [vertex] out of its home's triangle finds the one it is in now.
void go_home(WorkingMap& map, const std::vector<Vec2d>& before);

}  // namespace lozenge
