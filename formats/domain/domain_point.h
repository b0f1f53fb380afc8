// Positions on the domain, (i, alpha, beta), and the exact arithmetic on them (paper, Sec. 4).
//
// Every barycentric coordinate of a stored position is a multiple of 2^-40. Moving a position into the frame of a
// neighbouring triangle only adds and subtracts such coordinates (a side is shared, and the transition is a rotation
// by a multiple of 60 degrees), so it is exact; and the area of an image triangle is an integer determinant. That is
// how "no triangle is folded" and "the images tile the domain" are proved rather than estimated.
#pragma once

#include <array>
#include <cstdint>

#include "formats/base/vector.h"
#include "formats/domain/domain.h"

namespace lozenge {

/// Steps of the lattice in one unit of a barycentric coordinate.
inline constexpr std::int64_t kLatticeOne = std::int64_t{1} << 40;

/// Position (i, alpha, beta): alpha is the weight of corner 0, beta of corner 1, and gamma = 1 - alpha - beta of
/// corner 2. All three are multiples of 2^-40 from 0 to 1.
struct DomainPoint {
  DomainTriangleId triangle = -1;
  double alpha = 0;
  double beta = 0;

  double gamma() const { return 1 - alpha - beta; }
  friend bool operator==(const DomainPoint&, const DomainPoint&) = default;
};

/// The point of a triangle's frame that is nearest on the lattice to (alpha, beta), moved into the closed triangle
/// where it lies outside by rounding.
DomainPoint make_point(DomainTriangleId triangle, double alpha, double beta);

/// The corner itself.
DomainPoint corner_point(DomainCorner corner);

/// A point of a triangle's frame in exact coordinates: corner 0 is (0, 0), corner 1 is (kLatticeOne, 0), corner 2 is
/// (0, kLatticeOne). So u is beta and v is gamma, in lattice steps; the point may lie outside the triangle.
struct LatticePoint {
  std::int64_t u = 0;
  std::int64_t v = 0;

  friend LatticePoint operator+(LatticePoint a, LatticePoint b) { return {a.u + b.u, a.v + b.v}; }
  friend LatticePoint operator-(LatticePoint a, LatticePoint b) { return {a.u - b.u, a.v - b.v}; }
  friend bool operator==(const LatticePoint&, const LatticePoint&) = default;
};

LatticePoint lattice_point(const DomainPoint& p);
/// \pre the point is in the closed triangle
DomainPoint domain_point(DomainTriangleId triangle, LatticePoint p);
inline bool in_triangle(LatticePoint p) { return p.u >= 0 && p.v >= 0 && p.u + p.v <= kLatticeOne; }

/// Rotates by sixths of a turn, counter-clockwise; any integer.
LatticePoint rotated(LatticePoint p, int sixths);

/// A rigid motion of the lattice: a rotation by sixths of a turn, then a shift.
struct LatticeMotion {
  int sixths = 0;
  LatticePoint shift{};

  LatticePoint operator()(LatticePoint p) const { return rotated(p, sixths) + shift; }
};

/// First `inner`, then `outer`.
LatticeMotion composed(const LatticeMotion& outer, const LatticeMotion& inner);
LatticeMotion inverse(const LatticeMotion& motion);

/// Takes the frame of the triangle across side `from` (which is entered through its side `to`) into the frame of the
/// triangle that `from` belongs to.
LatticeMotion transition(int from_side, int to_side);

/// Takes the triangle's frame into the frame whose origin is its corner `corner` and whose u axis is the side that
/// leaves it.
LatticeMotion corner_frame(int corner);

/// Cartesian coordinates of a frame whose triangle has unit sides: u along x, v at 60 degrees.
Vec2d plane_point(LatticePoint p);
/// The nearest lattice point.
LatticePoint nearest_lattice_point(Vec2d p);

/// Twice the area of a lattice triangle in units of the unit cell: positive where counter-clockwise. Exact.
__extension__ typedef __int128 LatticeArea;
LatticeArea doubled_area(LatticePoint a, LatticePoint b, LatticePoint c);

/// Of one unit triangle. A domain of n triangles has exactly n times this.
inline constexpr LatticeArea kUnitTriangleDoubledArea = static_cast<LatticeArea>(kLatticeOne) * kLatticeOne;

}  // namespace lozenge
