// The convex polygon that the triangles around a domain vertex are laid out in.
#pragma once

#include "formats/domain/star_domain.h"

namespace lozenge {

/// Of a vertex inside, the regular polygon of as many corners as it has triangles, about the origin (Sec. 4.1). Of a
/// vertex on the boundary, the upper half of the regular polygon of twice as many: the boundary lies on its diameter,
/// the x axis, which it follows from the last corner through the centre to the first.
struct StarPolygon {
  int slices = 0;
  bool is_half = false;

  Vec2d corner(int i) const { return star_corner(is_half ? 2 * slices : slices, i); }
  /// Where a point in slice coordinates lies, and back.
  Vec2d point(const StarSlice& at, StarShape shape) const {
    return point_in_star(is_half ? 2 * slices : slices, at, shape);
  }
  StarSlice slice_at(const Vec2d& st, StarShape shape) const {
    return slice_in_star(is_half ? 2 * slices : slices, st, shape);
  }
  /// The number of the slice's second corner.
  int after(int slice) const { return is_half ? slice + 1 : (slice + 1) % slices; }
  bool is_on_diameter(const Vec2d& st) const { return is_half && st.y < kOnDiameter; }

  static constexpr double kOnDiameter = 1e-7;
};

}  // namespace lozenge
