// Which triangle of a charted surface each texel of a patch's tile is seen on.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "formats/patches/charted_surface.h"
#include "formats/patches/map_layout.h"
#include "formats/patches/tangent_frame.h"

namespace lozenge {

struct FramedSurface;

/// The texels of one tile, gutters too; of a map of lower resolution, one for every `shrink` x `shrink` of the
/// layout's.
class TriangleTile {
 public:
  static constexpr std::int32_t kNone = -1;

  /// \pre `shrink` divides the tile's size
  explicit TriangleTile(const MapTile& tile, std::int32_t shrink = 1);

  /// Texels a side.
  std::int32_t size() const { return size_; }
  /// Where the middle of texel (x, y), counted from the tile's first, lies: in steps of the layout's texels from the
  /// patch's (0, 0), as in `AtlasPlace`.
  Vec2d middle(std::int32_t x, std::int32_t y) const { return {first_ + x * step_, first_ + y * step_}; }
  /// The number of the triangle there, or `kNone`.
  std::int32_t at(std::int32_t x, std::int32_t y) const { return triangles_[static_cast<std::size_t>(y) * size_ + x]; }

  /// Gives a triangle of this patch all texels whose middles lie in it and that no other has.
  void draw(const ChartedTriangle& triangle, std::int32_t number);
  /// Texels that none covers take the triangle of one beside them, and so on: they aren't seen but by filters.
  void spread();

 private:
  std::int32_t size_;
  double first_;
  double step_;
  double last_;  ///< where u is 1
  std::vector<std::int32_t> triangles_;
};

/// Barycentric weights of a place; all -1 in a triangle without area.
Vec3d weights_in(const std::array<Vec2d, 3>& triangle, const Vec2d& place);

/// The frame at a place of a triangle's patch; where it lies beyond the triangle, that of a point on it.
ShadingFrame frame_at(const FramedSurface& framed, const ChartedTriangle& triangle, std::int32_t number,
                      const Vec2d& place);

/// [patch] its triangles.
std::vector<std::vector<std::int32_t>> triangles_by_patch(const ChartedSurface& surface, std::int32_t patches);

}  // namespace lozenge
