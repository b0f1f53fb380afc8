// Better domains of the same size: flips that lower the energy.
//
// Not in the paper, which flips where a path on the surface gets shorter (3), and only three times. The energy itself
// is the better judge, and on a proxy it is cheap to ask: an edge is flipped, the map relaxed, and the flip kept where
// that ends lower. Only flips that make valences more even, or leave them as even as they are, are tried: the others
// put cones of opposite curvature side by side.
#pragma once

#include "stages/parameterize/map/scratch.h"
#include "stages/parameterize/map/working_map.h"

namespace lozenge {

/// Tries flips until none lowers the energy, for a few rounds. Domains of few triangles are judged after the whole map
/// is relaxed (where a cone sits is then felt everywhere), larger ones after the four stars around are. \return how
/// many flips were kept
int improve_domain(WorkingMap& map, Scratch& scratch);

/// The same for the edges around one vertex, once, judged by the four stars: after a collapse has changed nothing but
/// its surroundings. Cones there are moved, too.
int improve_domain_around(WorkingMap& map, DomainVertex n, Scratch& scratch);

}  // namespace lozenge
