// The grid's quads are split as the exporter splits them, and frames are interpolated as engines do, so that what is
// baked is what will be drawn.
#include "formats/patches/target_surface.h"

#include <algorithm>

namespace lozenge {

TargetSurface::TargetSurface(const GeometryImage& image, int level, const MapLayout& layout)
    : image_(image), level_(level), vertices_(frame_vertices(image, level, layout)) {}

std::array<TargetSurface::Corner, 3> TargetSurface::corners_at(std::int32_t patch, double u, double v) const {
  const std::int32_t quads = vertices_.grids.samples(patch) - 1;
  const auto i = std::min(static_cast<std::int32_t>(u * quads), quads - 1);
  const auto j = std::min(static_cast<std::int32_t>(v * quads), quads - 1);
  const double x = u * quads - i;
  const double y = v * quads - j;
  if (i == j && !image_.layout.places[patch].right.exists()) {
    return {Corner{i, i, 1 - y}, {i + 1, i + 1, x}, {i, i + 1, y - x}};
  }
  if (x + y <= 1) return {Corner{i, j, 1 - x - y}, {i + 1, j, x}, {i, j + 1, y}};
  return {Corner{i + 1, j, 1 - y}, {i + 1, j + 1, x + y - 1}, {i, j + 1, 1 - x}};
}

TargetSurface::Point TargetSurface::at(std::int32_t patch, double u, double v) const {
  const std::array<Corner, 3> corners = corners_at(patch, u, v);
  Point point{{0, 0, 0}, {}};
  std::array<const FrameVertex*, 3> vertices{};
  Vec3d weights;
  for (int c = 0; c < 3; ++c) {
    const auto [i, j, weight] = corners[c];
    point.position += Vec3d(image_.position(level_, patch, i, j)) * weight;
    vertices[c] = &vertices_.at(patch, i, j);
    weights[c] = weight;
  }
  point.frame = shading_frame(vertices, weights);
  return point;
}

}  // namespace lozenge
