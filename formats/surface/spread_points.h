// Points spread evenly over a surface, the same ones every time.
#pragma once

#include <cstdint>
#include <vector>

#include "formats/surface/surface_view.h"

namespace lozenge {

struct SurfacePoint {
  TriangleId triangle = -1;
  Vec3d weights{1, 0, 0};  ///< barycentric
};

/// About `count` points, each standing for an equal share of the area: systematic sampling along the triangles in their
/// order, and in each triangle a low-discrepancy sequence. Nothing where no triangle has area.
std::vector<SurfacePoint> spread_points(const SurfaceView& surface, std::int64_t count);

Vec3d position_of(const SurfaceView& surface, const SurfacePoint& point);

}  // namespace lozenge
