// The bare geometry of anything made of triangles: what statistics, distances and pictures need of it.
#pragma once

#include <array>
#include <span>

#include "formats/base/vector.h"

namespace lozenge {

/// Points into somebody else's arrays: positions, and the corners of each triangle, counter-clockwise seen from
/// outside.
struct SurfaceView {
  std::span<const Vec3f> positions;
  std::span<const std::array<VertexId, 3>> triangles;
};

}  // namespace lozenge
