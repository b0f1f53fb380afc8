#include "formats/surface/nearest_point.h"

#include <algorithm>
#include <limits>

namespace lozenge {

namespace {

/// Weights of v0 and v1 of the point of their segment that is nearest to `p`.
std::array<double, 2> nearest_on_segment(const Vec3d& p, const Vec3d& v0, const Vec3d& v1) {
  const Vec3d e = v1 - v0;
  const double squared = e.dot(e);
  const double s = squared > 0 ? std::clamp((p - v0).dot(e) / squared, 0.0, 1.0) : 0.0;
  return {1 - s, s};
}

}  // namespace

Vec3d nearest_weights(const Vec3d& p, const std::array<Vec3d, 3>& t) {
  const Vec3d normal = (t[1] - t[0]).cross(t[2] - t[0]);
  if (const double squared = normal.dot(normal); squared > 0) {
    // Weights of the foot of the perpendicular: areas towards it, by the opposite sides.
    Vec3d w;
    for (int c = 0; c < 3; ++c) {
      const Vec3d& from = t[(c + 1) % 3];
      w[c] = (t[(c + 2) % 3] - from).cross(p - from).dot(normal) / squared;
    }
    if (w.x >= 0 && w.y >= 0 && w.z >= 0) return w / (w.x + w.y + w.z);
  }
  Vec3d best(1, 0, 0);
  double best_squared = std::numeric_limits<double>::infinity();
  for (int c = 0; c < 3; ++c) {
    const int d = (c + 1) % 3;
    const auto [wc, wd] = nearest_on_segment(p, t[c], t[d]);
    Vec3d w(0, 0, 0);
    w[c] = wc;
    w[d] = wd;
    const Vec3d away = point_at(t, w) - p;
    if (const double squared = away.dot(away); squared < best_squared) {
      best_squared = squared;
      best = w;
    }
  }
  return best;
}

Vec3d weights_of_step(const std::array<Vec3d, 3>& triangle, const Vec3d& step) {
  const Vec3d a = triangle[1] - triangle[0];
  const Vec3d b = triangle[2] - triangle[0];
  const double aa = a.dot(a);
  const double bb = b.dot(b);
  const double ab = a.dot(b);
  const double determinant = aa * bb - ab * ab;
  if (!(determinant > 0)) return {0, 0, 0};
  const double at_b = (bb * a.dot(step) - ab * b.dot(step)) / determinant;
  const double at_c = (aa * b.dot(step) - ab * a.dot(step)) / determinant;
  return {-at_b - at_c, at_b, at_c};
}

}  // namespace lozenge
