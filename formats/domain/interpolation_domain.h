// Interpolation domains (paper, Sec. 4.1): convex regions E of the plane, and functions g_E that map them onto a few
// adjacent domain triangles, quickly and both ways. Through them positions, segments and triangles that span several
// domain triangles are interpolated; and their restrictions partition the domain in three ways (Sec. 4.2).
#pragma once

#include <optional>
#include <vector>

#include "formats/base/vector.h"
#include "formats/domain/domain.h"
#include "formats/domain/domain_point.h"

namespace lozenge {

/// One domain triangle, as an equilateral triangle of unit sides.
class FaceDomain {
 public:
  FaceDomain(const Domain& domain, DomainTriangleId triangle);
  /// g_E. \return nothing outside of E
  std::optional<DomainPoint> to_domain(const Vec2d& st) const;
  /// The inverse. \return nothing where the point's triangle isn't this one
  std::optional<Vec2d> from_domain(const DomainPoint& p) const;

 private:
  DomainTriangleId triangle_;
};

/// Two triangles matched along a side, in the frame of the side's own triangle. Rigid.
class DiamondDomain {
 public:
  /// \pre the side has a neighbour
  DiamondDomain(const Domain& domain, DomainSide side);
  std::optional<DomainPoint> to_domain(const Vec2d& st) const;
  std::optional<Vec2d> from_domain(const DomainPoint& p) const;

 private:
  DomainSide side_;
  DomainSide across_;
};

/// How a star of a valence other than 6 is laid into the plane.
struct StarShape {
  /// 0: the regular polygon, each slice linear: areas are kept. 1: the slices' angles are scaled by a power of the
  /// complex variable: angles are kept, and the outline curves. In between: inverse images blended linearly.
  double conformality = 0;
};

/// The k triangles around a domain vertex, as a regular k-gon about the origin with the area of k unit triangles. Slice
/// i lies between polygon corners i and i + 1, and stands for the i-th triangle counter-clockwise. For k = 6, and only
/// then, g_E is rigid.
class StarDomain {
 public:
  /// \pre the vertex of `first` is not on the boundary
  StarDomain(const Domain& domain, DomainCorner first, StarShape shape = {});
  std::optional<DomainPoint> to_domain(const Vec2d& st) const;
  std::optional<Vec2d> from_domain(const DomainPoint& p) const;

  int valence() const { return static_cast<int>(corners_.size()); }
  const std::vector<DomainCorner>& corners() const { return corners_; }

 private:
  std::vector<DomainCorner> corners_;
  StarShape shape_;
};

/// Distance from the centre to the corners of the regular polygon of `valence` sides with the area of as many unit
/// triangles.
double star_radius(int valence);
/// Corner i of that polygon; the first lies on the x axis.
Vec2d star_corner(int valence, int i);

/// A point of a star by its slice and the weights of the slice's two outer corners; the centre has the rest.
struct StarSlice {
  int slice = 0;
  double first = 0;
  double second = 0;
};

/// g_E of a star and its inverse, in these terms.
StarSlice slice_in_star(int valence, const Vec2d& st, StarShape shape);
Vec2d point_in_star(int valence, const StarSlice& at, StarShape shape);

/// Linear interpolation between two positions (paper, eq. 1), over the smallest domain that holds both.
/// \return nothing where no face, diamond or star holds them
std::optional<DomainPoint> interpolate(const Domain& domain, const DomainPoint& p, const DomainPoint& q, double share);

/// The three partitions (Sec. 4.2). A point belongs to one face domain, to one half-diamond (of the side opposite the
/// corner with the smallest barycentric coordinate) and to one half-star (of the corner with the largest).
DomainSide half_diamond_of(const Domain& domain, const DomainPoint& p);
DomainVertex half_star_of(const Domain& domain, const DomainPoint& p);

/// Distance from a point to the border of the part that holds it, for each partition, in sides of the triangle: no
/// point is near the border of all three, so the partitions leave no permanent boundary.
struct BorderDistances {
  double face = 0;
  double half_diamond = 0;
  double half_star = 0;
};
BorderDistances border_distances(const DomainPoint& p);

}  // namespace lozenge
