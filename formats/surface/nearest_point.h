// The point of a triangle that is nearest to another point.
#pragma once

#include <array>

#include "formats/base/vector.h"

namespace lozenge {

/// The point of a triangle that has these barycentric weights.
inline Vec3d point_at(const std::array<Vec3d, 3>& triangle, const Vec3d& weights) {
  return triangle[0] * weights.x + triangle[1] * weights.y + triangle[2] * weights.z;
}

/// The point of a triangle that is nearest to `p`, by its barycentric weights, none below 0. Exact up to rounding for
/// triangles of any shape, those without area too.
Vec3d nearest_weights(const Vec3d& p, const std::array<Vec3d, 3>& triangle);

/// The change of the weights that moves a point of the triangle by `step`, laid into its plane; none where the triangle
/// has no area.
Vec3d weights_of_step(const std::array<Vec3d, 3>& triangle, const Vec3d& step);

}  // namespace lozenge
