// The motions between the frames of domain triangles, in floating point: what `LatticeMotion` is exactly.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "formats/base/vector.h"

namespace lozenge {

inline constexpr double kHalfRoot3 = 0.86602540378443864676;

/// A whole multiple of the unit steps of the triangular lattice: u along x, v at 60 degrees.
struct UnitPoint {
  std::int16_t u = 0;
  std::int16_t v = 0;

  friend UnitPoint operator+(UnitPoint a, UnitPoint b) {
    return {static_cast<std::int16_t>(a.u + b.u), static_cast<std::int16_t>(a.v + b.v)};
  }
  friend UnitPoint operator-(UnitPoint a, UnitPoint b) {
    return {static_cast<std::int16_t>(a.u - b.u), static_cast<std::int16_t>(a.v - b.v)};
  }
  friend bool operator==(const UnitPoint&, const UnitPoint&) = default;
};

/// Rotates by sixths of a turn, counter-clockwise; 0 to 5.
inline UnitPoint turned(UnitPoint p, int sixths) {
  const auto point = [](int u, int v) { return UnitPoint{static_cast<std::int16_t>(u), static_cast<std::int16_t>(v)}; };
  switch (sixths) {
    case 0:
      return p;
    case 1:
      return point(-p.v, p.u + p.v);
    case 2:
      return point(-p.u - p.v, p.u);
    case 3:
      return point(-p.u, -p.v);
    case 4:
      return point(p.v, -p.u - p.v);
    default:
      return point(p.u + p.v, -p.u);
  }
}

inline constexpr std::array<double, 6> kCosOfSixths{1, 0.5, -0.5, -1, -0.5, 0.5};
inline constexpr std::array<double, 6> kSinOfSixths{0, kHalfRoot3, kHalfRoot3, 0, -kHalfRoot3, -kHalfRoot3};

/// A rotation by sixths of a turn (0 to 5), then a shift by whole steps: every transition between two frames of the
/// domain is one, along whatever way.
struct UnitMotion {
  std::int16_t sixths = 0;
  UnitPoint shift;

  Vec2d operator()(const Vec2d& p) const {
    const double cos = kCosOfSixths[sixths];
    const double sin = kSinOfSixths[sixths];
    return {cos * p.x - sin * p.y + (shift.u + 0.5 * shift.v), sin * p.x + cos * p.y + kHalfRoot3 * shift.v};
  }
  UnitPoint operator()(UnitPoint p) const { return turned(p, sixths) + shift; }
  friend bool operator==(const UnitMotion&, const UnitMotion&) = default;
};

/// First `inner`, then `outer`.
inline UnitMotion composed(const UnitMotion& outer, const UnitMotion& inner) {
  const int sixths = outer.sixths + inner.sixths;
  return {static_cast<std::int16_t>(sixths < 6 ? sixths : sixths - 6), outer(inner.shift)};
}

inline UnitMotion inverse(const UnitMotion& m) {
  const int sixths = m.sixths == 0 ? 0 : 6 - m.sixths;
  return {static_cast<std::int16_t>(sixths), turned(UnitPoint{} - m.shift, sixths)};
}

/// Rotation about the origin; any integer.
inline UnitMotion rotation(int sixths) { return {static_cast<std::int16_t>(((sixths % 6) + 6) % 6), {}}; }

/// The motion of the segment p, q onto the segment `to_p`, `to_q`, which are the same but for one.
UnitMotion motion_of_segment(const Vec2d& p, const Vec2d& q, const Vec2d& to_p, const Vec2d& to_q);

/// Takes the frame of the triangle that is entered through its side `to` into the frame of the one left through its
/// side `from`.
const UnitMotion& unit_transition(int from_side, int to_side);

/// Takes the triangle's frame into the one with its origin in a corner and the x axis along the side that leaves it.
const UnitMotion& to_corner_frame(int corner);
const UnitMotion& from_corner_frame(int corner);

/// Corner c of a domain triangle in its own frame.
inline UnitPoint corner_step(int corner) {
  return {static_cast<std::int16_t>(corner == 1), static_cast<std::int16_t>(corner == 2)};
}
inline constexpr std::array<double, 6> kCornerCoordinates{0, 0, 1, 0, 0.5, kHalfRoot3};
inline Vec2d corner_position(int corner) {
  return {kCornerCoordinates[2 * corner], kCornerCoordinates[2 * corner + 1]};
}

/// Barycentric weights of the three corners at a point of the frame.
inline std::array<double, 3> barycentrics(const Vec2d& p) {
  const double gamma = p.y / kHalfRoot3;
  const double beta = p.x - 0.5 * gamma;
  return {1 - beta - gamma, beta, gamma};
}

inline Vec2d at_barycentrics(double beta, double gamma) { return {beta + 0.5 * gamma, kHalfRoot3 * gamma}; }

inline double cross(const Vec2d& a, const Vec2d& b) { return a.x * b.y - a.y * b.x; }

}  // namespace lozenge
