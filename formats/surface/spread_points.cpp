// A sequence that fills the square evenly gives each triangle points by its area: no random numbers, and any number of
// points.
#include "formats/surface/spread_points.h"

#include <algorithm>
#include <cmath>

namespace lozenge {

namespace {

/// Martin Roberts' R2 sequence: fractions of multiples of 1/g and 1/g^2, g the plastic number (g^3 = g + 1).
constexpr double kFirstStep = 0.75487766624669276005;
constexpr double kSecondStep = 0.56984029099805326591;

double fraction(double x) { return x - std::floor(x); }

/// The square folded onto the triangle along its diagonal: keeps areas.
Vec3d weights_in_triangle(std::int64_t index) {
  const auto i = static_cast<double>(index);
  double u = fraction(0.5 + i * kFirstStep);
  double v = fraction(0.5 + i * kSecondStep);
  if (u + v > 1) {
    u = 1 - u;
    v = 1 - v;
  }
  return {1 - u - v, u, v};
}

double area_of(const SurfaceView& surface, std::size_t t) {
  const auto& [a, b, c] = surface.triangles[t];
  const Vec3d p(surface.positions[a]);
  return (Vec3d(surface.positions[b]) - p).cross(Vec3d(surface.positions[c]) - p).length() / 2;
}

}  // namespace

std::vector<SurfacePoint> spread_points(const SurfaceView& surface, std::int64_t count) {
  double total = 0;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) total += area_of(surface, t);
  if (!(total > 0) || !std::isfinite(total) || count <= 0) return {};
  std::vector<SurfacePoint> points;
  points.reserve(static_cast<std::size_t>(count));
  double covered = 0;
  std::int64_t given = 0;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    covered += area_of(surface, t);
    // Point k stands at (k + 1/2) / count of the area.
    const auto due =
        std::min(count, static_cast<std::int64_t>(std::floor(covered / total * static_cast<double>(count) + 0.5)));
    for (; given < due; ++given) points.push_back({static_cast<TriangleId>(t), weights_in_triangle(given)});
  }
  return points;
}

Vec3d position_of(const SurfaceView& surface, const SurfacePoint& point) {
  const auto& [a, b, c] = surface.triangles[point.triangle];
  return Vec3d(surface.positions[a]) * point.weights.x + Vec3d(surface.positions[b]) * point.weights.y +
         Vec3d(surface.positions[c]) * point.weights.z;
}

}  // namespace lozenge
