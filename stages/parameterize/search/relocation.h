// Better domains of the same size: vertices are taken from where they matter least to where they matter most.
//
// Not in the paper: a collapse, and its inverse somewhere else.
#pragma once

#include "stages/parameterize/map/path_lengths.h"
#include "stages/parameterize/map/working_map.h"

namespace lozenge {

/// Gives a vertex where that lowers the energy most and takes one away where that raises it least, as long as the
/// energy of the whole relaxed map falls, at most `most_moves` times; then the same with three and two vertices at
/// once, some times. The number of triangles stays. \return how often it fell
int relocate_vertices(WorkingMap& map, SurfaceMeasures& measures, int most_moves);

}  // namespace lozenge
