#include "formats/surface/normal_transform.h"

#include <algorithm>
#include <cmath>

namespace lozenge {

namespace {

/// Squared length of normals that are left as they are: rounding a unit vector to floats changes it by less, so that
/// normalizing twice is normalizing once.
constexpr double kUnitTolerance = 1e-6;

}  // namespace

NormalTransform::NormalTransform(const Imath::M44d& m) {
  const Vec3d x(m[0][0], m[0][1], m[0][2]);
  const Vec3d y(m[1][0], m[1][1], m[1][2]);
  const Vec3d z(m[2][0], m[2][1], m[2][2]);
  is_identity = x == Vec3d(1, 0, 0) && y == Vec3d(0, 1, 0) && z == Vec3d(0, 0, 1);
  mirrored = x.cross(y).dot(z) < 0;
  const double sign = mirrored ? -1 : 1;
  rows = {y.cross(z) * sign, z.cross(x) * sign, x.cross(y) * sign};
  axes = {x, y, z};
}

Vec3f NormalTransform::offset(const Vec3f& d) const {
  if (is_identity) return without_negative_zeros(d);
  const Vec3d given(d);
  return without_negative_zeros(Vec3f(axes[0] * given.x + axes[1] * given.y + axes[2] * given.z));
}

Vec3f NormalTransform::operator()(const Vec3f& n) const {
  const Vec3d given(n);
  if (is_identity && std::abs(given.dot(given) - 1) <= kUnitTolerance) return without_negative_zeros(n);
  const Vec3d turned = rows[0] * given.x + rows[1] * given.y + rows[2] * given.z;
  // Scaled first: squares of very small or large numbers leave the range of doubles.
  const double largest = std::max({std::abs(turned.x), std::abs(turned.y), std::abs(turned.z)});
  if (!(largest > 0) || !std::isfinite(largest)) return {0, 0, 0};
  const Vec3d scaled = turned / largest;
  return without_negative_zeros(Vec3f(scaled / std::sqrt(scaled.dot(scaled))));
}

}  // namespace lozenge
