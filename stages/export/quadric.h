// Quadrics: sums of squared distances to planes and points, as a function of where a vertex lies (Garland and Heckbert,
// Surface Simplification Using Quadric Error Metrics, SIGGRAPH 1997).
#pragma once

#include "formats/base/vector.h"

namespace lozenge {

/// x A x + 2 b x + c, of positions x.
struct Quadric {
  double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;  ///< A, which is symmetric
  Vec3d b{0, 0, 0};
  double c = 0;

  /// Adds `weight` times the squared distance to the plane through `point` with a unit normal.
  void add_plane(const Vec3d& normal, const Vec3d& point, double weight);
  /// Adds `weight` times the squared distance to a point.
  void add_point(const Vec3d& point, double weight);
  Quadric& operator+=(const Quadric& other);

  double at(const Vec3d& x) const;
  /// Where it is least. \pre points were added, not only planes: there is one such place then
  Vec3d least() const;
};

}  // namespace lozenge
