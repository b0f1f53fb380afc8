// The surface that the maps are for: one level of detail, as a renderer sees it.
#pragma once

#include <array>

#include "formats/patches/geometry_image.h"
#include "formats/patches/tangent_frame.h"

namespace lozenge {

class TargetSurface {
 public:
  /// Keeps a reference to `image`.
  TargetSurface(const GeometryImage& image, int level, const MapLayout& layout);

  struct Point {
    Vec3d position;
    ShadingFrame frame;
  };
  /// The point of the level's triangle that holds the place (u, v) of the patch.
  /// \pre  0 <= u, v <= 1, and v >= u where the patch has no right triangle
  Point at(std::int32_t patch, double u, double v) const;

 private:
  struct Corner {
    std::int32_t i = 0;
    std::int32_t j = 0;
    double weight = 0;
  };
  std::array<Corner, 3> corners_at(std::int32_t patch, double u, double v) const;

  const GeometryImage& image_;
  std::int32_t level_;
  FrameVertices vertices_;
};

}  // namespace lozenge
