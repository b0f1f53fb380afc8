// The bounding box, cut by the half-plane of every side in turn: outlines have few sides.
#include "stages/parameterize/map/kernel.h"

#include <algorithm>

#include "stages/parameterize/map/plane_motion.h"

namespace lozenge {

std::vector<Vec2d> kernel_of(const std::vector<Vec2d>& ring) {
  // The bounding box, cut by every side's half-plane in turn.
  Vec2d low = ring[0], high = ring[0];
  for (const Vec2d& p : ring) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  std::vector<Vec2d> kernel{low, {high.x, low.y}, high, {low.x, high.y}};
  std::vector<Vec2d> cut;
  for (std::size_t i = 0; i < ring.size() && !kernel.empty(); ++i) {
    const Vec2d p = ring[i];
    const Vec2d side = ring[i + 1 == ring.size() ? 0 : i + 1] - p;
    cut.clear();
    for (std::size_t j = 0; j < kernel.size(); ++j) {
      const Vec2d a = kernel[j];
      const Vec2d b = kernel[j + 1 == kernel.size() ? 0 : j + 1];
      const double inside_a = cross(side, a - p);
      const double inside_b = cross(side, b - p);
      if (inside_a >= 0) cut.push_back(a);
      if ((inside_a > 0 && inside_b < 0) || (inside_a < 0 && inside_b > 0)) {
        cut.push_back(a + (b - a) * (inside_a / (inside_a - inside_b)));
      }
    }
    kernel.swap(cut);
  }
  if (kernel.size() < 3) kernel.clear();
  return kernel;
}

std::optional<Vec2d> point_of_kernel(const std::vector<Vec2d>& ring) {
  const std::vector<Vec2d> kernel = kernel_of(ring);
  if (kernel.empty()) return std::nullopt;
  Vec2d sum(0, 0);
  for (const Vec2d& p : kernel) sum += p;
  return sum / static_cast<double>(kernel.size());
}

}  // namespace lozenge
