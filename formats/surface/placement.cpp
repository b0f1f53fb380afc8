#include "formats/surface/placement.h"

#include <algorithm>
#include <cmath>

namespace lozenge {

namespace {

/// How far from a right angle a rounded rotation's axes may be, as a cosine; the glTF validator allows more.
constexpr double kMostShear = 1e-5;

/// Least share that the volume of the images of the axes has of the cube over the longest of them.
constexpr double kLeastVolume = 1e-6;

Vec3d axis(const Placement& m, int i) { return {m[4 * i], m[4 * i + 1], m[4 * i + 2]}; }

double volume(const Placement& m) { return axis(m, 0).cross(axis(m, 1)).dot(axis(m, 2)); }

bool is_affine(const Placement& m) {
  return std::all_of(m.begin(), m.end(), [](double x) { return std::isfinite(x); }) && m[3] == 0 && m[7] == 0 &&
         m[11] == 0 && m[15] == 1;
}

}  // namespace

Imath::M44d matrix_of(const Placement& m) {
  return {m[0], m[1], m[2], m[3], m[4], m[5], m[6], m[7], m[8], m[9], m[10], m[11], m[12], m[13], m[14], m[15]};
}

Placement placement_of(const Imath::M44d& matrix) {
  Placement placement{};
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 3; ++column) placement[4 * row + column] = matrix[row][column];
  }
  placement[15] = 1;
  return placement;
}

Vec3f placed(const Placement& m, const Vec3f& p) {
  return Vec3f(axis(m, 0) * p.x + axis(m, 1) * p.y + axis(m, 2) * p.z + axis(m, 3));
}

Vec3d placed(const Imath::M44d& m, const Vec3d& p) {
  Vec3d moved;
  for (int axis = 0; axis < 3; ++axis)
    moved[axis] = p.x * m[0][axis] + p.y * m[1][axis] + p.z * m[2][axis] + m[3][axis];
  return moved;
}

bool is_mirroring(const Placement& placement) { return volume(placement) < 0; }

bool is_node_transform(const Placement& m) {
  if (!is_affine(m)) return false;
  for (int i = 0; i < 3; ++i) {
    const Vec3d a = axis(m, i);
    const Vec3d b = axis(m, (i + 1) % 3);
    // (Also false where one of them is no number or has no length.)
    if (!(std::abs(a.dot(b)) < kMostShear * a.length() * b.length())) return false;
  }
  return true;
}

bool is_invertible(const Placement& m) {
  if (!is_affine(m)) return false;
  const double longest = std::max({axis(m, 0).length(), axis(m, 1).length(), axis(m, 2).length()});
  return std::abs(volume(m)) > kLeastVolume * longest * longest * longest;
}

Imath::M44d counted_from(const Vec3d& origin, Imath::M44d transform) {
  if (origin == Vec3d(0, 0, 0)) return transform;
  for (int axis = 0; axis < 3; ++axis) transform[3][axis] -= origin[axis];
  return transform;
}

}  // namespace lozenge
