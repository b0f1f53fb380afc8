#include "stages/import/cap_polygon.h"

#include <cmath>
#include <limits>
#include <utility>

namespace lozenge {

namespace {

double area(const Vec3d& a, const Vec3d& b, const Vec3d& c) { return (b - a).cross(c - a).length() / 2; }

double cost(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  // The share that prefers well shaped triangles where areas don't decide, as in a plane.
  constexpr double kShape = 0.1;
  const double equilateral = ((b - a).length2() + (c - b).length2() + (a - c).length2()) / (4 * std::sqrt(3.0));
  return area(a, b, c) + kShape * equilateral;
}

}  // namespace

std::optional<PolygonCap> cap_polygon(const std::vector<Vec3d>& corners,
                                      const std::function<bool(std::int32_t, std::int32_t)>& may_join) {
  constexpr double kImpossible = std::numeric_limits<double>::infinity();
  const auto n = static_cast<std::int32_t>(corners.size());
  const auto at = [n](std::int32_t i, std::int32_t k) { return static_cast<std::size_t>(i) * n + k; };
  // [i, k] the least cost of the polygon of the corners i to k, and its corner in the triangle at the side (i, k).
  std::vector<double> least(static_cast<std::size_t>(n) * n, 0);
  std::vector<std::int32_t> apex(least.size(), -1);
  for (std::int32_t length = 2; length < n; ++length) {
    for (std::int32_t i = 0; i + length < n; ++i) {
      const std::int32_t k = i + length;
      double& best = least[at(i, k)];
      best = kImpossible;
      if (length < n - 1 && !may_join(i, k)) continue;
      for (std::int32_t j = i + 1; j < k; ++j) {
        const double below = least[at(i, j)] + least[at(j, k)];
        if (!(below < best)) continue;
        const double sum = below + cost(corners[i], corners[j], corners[k]);
        if (!(sum < best)) continue;
        best = sum;
        apex[at(i, k)] = j;
      }
    }
  }
  if (apex[at(0, n - 1)] < 0) return std::nullopt;
  PolygonCap cap;
  std::vector<std::pair<std::int32_t, std::int32_t>> open{{0, n - 1}};
  while (!open.empty()) {
    const auto [i, k] = open.back();
    open.pop_back();
    if (k - i < 2) continue;
    const std::int32_t j = apex[at(i, k)];
    cap.triangles.push_back({i, j, k});
    cap.area += area(corners[i], corners[j], corners[k]);
    open.emplace_back(i, j);
    open.emplace_back(j, k);
  }
  return cap;
}

}  // namespace lozenge
