// The kernel of a polygon: the points that see all of it, so that a vertex at one of them folds no triangle of the
// ring.
#pragma once

#include <optional>
#include <vector>

#include "formats/base/vector.h"

namespace lozenge {

/// The kernel of a polygon (counter-clockwise): the convex polygon of the points that see all of it. Empty where there
/// are none.
std::vector<Vec2d> kernel_of(const std::vector<Vec2d>& ring);

/// The middle of a polygon's kernel, the points that see all of it; nothing where it has none. Corners
/// counter-clockwise, at least 3.
std::optional<Vec2d> point_of_kernel(const std::vector<Vec2d>& ring);

}  // namespace lozenge
