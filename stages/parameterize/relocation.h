// Better domains of the same size: vertices are taken from where they matter least to where they matter most.
//
// Not in the paper: a collapse, and its inverse somewhere else.
#pragma once

#include "stages/parameterize/path_lengths.h"
#include "stages/parameterize/working_map.h"

namespace lozenge {

/// Takes a vertex away where that raises the energy least and gives one where that lowers it most, as long as the
/// energy of the whole relaxed map falls, at most `most_moves` times; the number of triangles stays. \return how often
/// it fell
int relocate_vertices(WorkingMap& map, SurfaceMeasures& measures, int most_moves);

}  // namespace lozenge
