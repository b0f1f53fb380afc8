// The motions between the frames of domain triangles, in floating point: what `LatticeMotion` is exactly.
#pragma once

#include <array>
#include <cmath>

#include "formats/vector.h"

namespace lozenge {

inline constexpr double kHalfRoot3 = 0.86602540378443864676;

/// A rotation and a shift of the plane.
struct PlaneMotion {
  double cos = 1;
  double sin = 0;
  double x = 0;
  double y = 0;

  Vec2d operator()(const Vec2d& p) const { return {cos * p.x - sin * p.y + x, sin * p.x + cos * p.y + y}; }
};

/// Rotation about the origin by sixths of a turn; any integer.
inline Vec2d turned(const Vec2d& p, int sixths) {
  switch (((sixths % 6) + 6) % 6) {
    case 0:
      return p;
    case 1:
      return {0.5 * p.x - kHalfRoot3 * p.y, kHalfRoot3 * p.x + 0.5 * p.y};
    case 2:
      return {-0.5 * p.x - kHalfRoot3 * p.y, kHalfRoot3 * p.x - 0.5 * p.y};
    case 3:
      return {-p.x, -p.y};
    case 4:
      return {-0.5 * p.x + kHalfRoot3 * p.y, -kHalfRoot3 * p.x - 0.5 * p.y};
    default:
      return {0.5 * p.x + kHalfRoot3 * p.y, -kHalfRoot3 * p.x + 0.5 * p.y};
  }
}

/// Corner c of a domain triangle in its own frame.
inline constexpr std::array<double, 6> kCornerCoordinates{0, 0, 1, 0, 0.5, kHalfRoot3};
inline Vec2d corner_position(int corner) {
  return {kCornerCoordinates[2 * corner], kCornerCoordinates[2 * corner + 1]};
}

/// From the triangle's frame into the one with its origin in a corner and the x axis along the side that leaves it.
inline Vec2d to_corner_frame(int corner, const Vec2d& p) { return turned(p - corner_position(corner), -2 * corner); }
inline Vec2d from_corner_frame(int corner, const Vec2d& p) { return turned(p, 2 * corner) + corner_position(corner); }

/// Takes the frame of the triangle that is entered through its side `to` into the frame of the one left through its
/// side `from`.
const PlaneMotion& plane_transition(int from_side, int to_side);

/// Barycentric weights of the three corners at a point of the frame.
inline std::array<double, 3> barycentrics(const Vec2d& p) {
  const double gamma = p.y / kHalfRoot3;
  const double beta = p.x - 0.5 * gamma;
  return {1 - beta - gamma, beta, gamma};
}

inline Vec2d at_barycentrics(double beta, double gamma) { return {beta + 0.5 * gamma, kHalfRoot3 * gamma}; }

inline double cross(const Vec2d& a, const Vec2d& b) { return a.x * b.y - a.y * b.x; }

}  // namespace lozenge
