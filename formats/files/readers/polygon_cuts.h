// Polygons cut into triangles.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "formats/base/vector.h"

namespace lozenge {

/// Cuts a polygon of n corners into n - 2 triangles of the same orientation, [corner of the polygon]. A convex one
/// becomes a fan around its first corner. A notched one, or one with corners along a straight side, is taken apart ear
/// by ear (G. H. Meisters, Polygons have ears, 1975), seen along its normal, as long as it has at most 128 corners;
/// what has no ear any more, being crossed by itself, becomes a fan all the same. \param triangles  is filled in
void cut_polygon(std::span<const Vec3f> corners, std::vector<std::array<std::uint32_t, 3>>& triangles);

}  // namespace lozenge
