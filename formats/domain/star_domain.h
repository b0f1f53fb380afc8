// Star domains (paper, Sec. 4.1): the k triangles around a domain vertex, as a region of the plane.
//
// Of the paper's three interpolation domains, face and diamond are rigid, and so is a star of six triangles: `develop`
// lays them out flat. A star of another valence has a cone in its middle and no flat image; where something has to
// cross it (a cone that moves, an operation that makes a vertex or removes one), its triangles are laid out as the
// slices of a regular k-gon.
#pragma once

#include "formats/base/vector.h"

namespace lozenge {

/// How a star of a valence other than 6 is laid into the plane.
struct StarShape {
  /// 0: the regular polygon, each slice linear: areas are kept. 1: the slices' angles are scaled by a power of the
  /// complex variable: angles are kept, and the outline curves. In between: inverse images blended linearly.
  double conformality = 0;
};

/// Distance from the centre to the corners of the star domain of `valence` triangles: the regular polygon about the
/// origin with the area of as many unit triangles. Slice i lies between polygon corners i and i + 1, and stands for the
/// i-th triangle counter-clockwise.
double star_radius(int valence);
/// Corner i of that polygon; the first lies on the x axis.
Vec2d star_corner(int valence, int i);

/// A point of a star by its slice and the weights of the slice's two outer corners; the centre has the rest.
struct StarSlice {
  int slice = 0;
  double first = 0;
  double second = 0;
};

/// Where a place of the domain lies in the star: the inverse of the paper's g_E. For valence 6, and only then, rigid.
Vec2d point_in_star(int valence, const StarSlice& at, StarShape shape);
/// The place of the domain at a point of the star: g_E.
StarSlice slice_in_star(int valence, const Vec2d& st, StarShape shape);

}  // namespace lozenge
