#include "formats/patches/triangle_tile.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "formats/patches/framed_surface.h"

namespace lozenge {

TriangleTile::TriangleTile(const MapTile& tile, std::int32_t shrink)
    : size_(tile.size / shrink),
      first_(0.5 * shrink - 0.5 - tile.gutter),
      step_(shrink),
      last_(tile.inner() - 1),
      triangles_(static_cast<std::size_t>(size_) * size_, kNone) {}

void TriangleTile::draw(const ChartedTriangle& triangle, std::int32_t number) {
  std::array<Vec2d, 3> p;
  for (int c = 0; c < 3; ++c) p[c] = triangle.corners[c].place * last_;
  // Texels whose middles lie between the least and the largest of three coordinates.
  const auto range = [&](double a, double b, double c) {
    const auto [low, high] = std::minmax({a, b, c});
    constexpr double kSlack = 1e-6;
    const double end = size_ - 1;
    return std::pair(static_cast<std::int32_t>(std::clamp(std::ceil((low - kSlack - first_) / step_), 0.0, end + 1)),
                     static_cast<std::int32_t>(std::clamp(std::floor((high + kSlack - first_) / step_), -1.0, end)));
  };
  const auto [left, right] = range(p[0].x, p[1].x, p[2].x);
  const auto [top, bottom] = range(p[0].y, p[1].y, p[2].y);
  for (std::int32_t y = top; y <= bottom; ++y) {
    for (std::int32_t x = left; x <= right; ++x) {
      std::int32_t& texel = triangles_[static_cast<std::size_t>(y) * size_ + x];
      constexpr double kRounding = 1e-6;
      const Vec3d w = weights_in(p, middle(x, y));
      if (texel == kNone && std::min({w.x, w.y, w.z}) >= -kRounding) texel = number;
    }
  }
}

void TriangleTile::spread() {
  std::vector<std::int32_t> done;
  for (std::int32_t i = 0; i < static_cast<std::int32_t>(triangles_.size()); ++i) {
    if (triangles_[i] != kNone) done.push_back(i);
  }
  for (std::size_t next = 0; next < done.size(); ++next) {
    const std::int32_t x = done[next] % size_;
    const std::int32_t y = done[next] / size_;
    const auto reach = [&](std::int32_t i, std::int32_t j) {
      if (i < 0 || j < 0 || i >= size_ || j >= size_) return;
      const std::int32_t index = j * size_ + i;
      if (triangles_[index] != kNone) return;
      triangles_[index] = triangles_[done[next]];
      done.push_back(index);
    };
    reach(x - 1, y);
    reach(x + 1, y);
    reach(x, y - 1);
    reach(x, y + 1);
  }
}

Vec3d weights_in(const std::array<Vec2d, 3>& triangle, const Vec2d& place) {
  const auto& [p, q, r] = triangle;
  const auto area = [](const Vec2d& a, const Vec2d& b, const Vec2d& c) { return (b - a).cross(c - a); };
  const double whole = area(p, q, r);
  if (!(std::abs(whole) > 0)) return {-1, -1, -1};
  return Vec3d(area(place, q, r), area(place, r, p), area(place, p, q)) / whole;
}

ShadingFrame frame_at(const FramedSurface& framed, const ChartedTriangle& triangle, std::int32_t number,
                      const Vec2d& place) {
  std::array<Vec2d, 3> p;
  std::array<const FrameVertex*, 3> corners{};
  for (int c = 0; c < 3; ++c) {
    p[c] = triangle.corners[c].place;
    corners[c] = &framed.vertices[framed.indices[3 * static_cast<std::size_t>(number) + static_cast<std::size_t>(c)]];
  }
  Vec3d weights = weights_in(p, place);
  for (int c = 0; c < 3; ++c) weights[c] = std::max(weights[c], 0.0);
  const double sum = weights.x + weights.y + weights.z;
  return shading_frame(corners, sum > 0 ? weights / sum : Vec3d(1, 0, 0));
}

std::vector<std::vector<std::int32_t>> triangles_by_patch(const ChartedSurface& surface, std::int32_t patches) {
  std::vector<std::vector<std::int32_t>> lists(static_cast<std::size_t>(patches));
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    lists[surface.triangles[t].patch].push_back(static_cast<std::int32_t>(t));
  }
  return lists;
}

}  // namespace lozenge
