// The warm-up (paper, Sec. 5.7.1): while domain triangles hold few source vertices, domain vertices have positions in
// space.
#pragma once

#include "stages/parameterize/map/path_lengths.h"
#include "stages/parameterize/map/working_map.h"

namespace lozenge {

/// Measures of the trivial map: every domain vertex lies where its source vertex does.
SurfaceMeasures trivial_measures(const WorkingMap& map);

/// Position in space for the vertex that a collapse of `side` would make: the one that best keeps the total area around
/// and the angles along the rim, by least squares.
Vec3d embed_collapsed_vertex(const WorkingMap& map, const SurfaceMeasures& measures, DomainSide side);

}  // namespace lozenge
