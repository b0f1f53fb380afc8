// How much of the triangles of a surface can be seen from outside: what is hidden needs little fidelity.
#pragma once

#include <vector>

#include "formats/patches/charted_surface.h"
#include "formats/surface/ray_scene.h"

namespace lozenge {

/// [triangle] the share of the sky, weighed by cosine, that it sees from the side that sees more of it: 1 on a convex
/// surface; and a tenth inside of a closed one, for what is hidden at rest may be bared by a movement.
/// \param scene  of what hides it
std::vector<float> exposure_of(const ChartedSurface& surface, const RayScene& scene);

}  // namespace lozenge
