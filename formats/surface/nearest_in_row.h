// Nearest points of a row of points that lie close to one another mostly: each search begins where the one before
// ended.
#pragma once

#include <cstddef>

#include "formats/surface/ray_scene.h"

namespace lozenge {

/// Calls `visit(i, what of the scene is nearest to position(i))` for the numbers from `begin` to before `end`.
template <typename Position, typename Visit>
void visit_nearest_in_row(const RayScene& scene, std::size_t begin, std::size_t end, const Position& position,
                          const Visit& visit) {
  NearestPoint near;
  for (std::size_t i = begin; i < end; ++i) {
    near = scene.nearest_from(near.triangle, position(i));
    visit(i, near);
  }
}

}  // namespace lozenge
