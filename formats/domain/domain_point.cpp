// The lattice has the symmetry of the triangles: turning by a sixth maps it to itself, so that every change of frame is
// integer arithmetic.
#include "formats/domain/domain_point.h"

#include <algorithm>
#include <cmath>

namespace lozenge {

namespace {

constexpr double kHalfRoot3 = 0.86602540378443864676;

std::int64_t to_lattice(double x) { return std::llround(x * static_cast<double>(kLatticeOne)); }
double from_lattice(std::int64_t x) { return static_cast<double>(x) / static_cast<double>(kLatticeOne); }

}  // namespace

DomainPoint make_point(DomainTriangleId triangle, double alpha, double beta) {
  const std::int64_t a = std::clamp<std::int64_t>(to_lattice(alpha), 0, kLatticeOne);
  const std::int64_t b = std::clamp<std::int64_t>(to_lattice(beta), 0, kLatticeOne - a);
  return {triangle, from_lattice(a), from_lattice(b)};
}

DomainPoint corner_point(DomainCorner corner) {
  return {corner.triangle, corner.corner == 0 ? 1.0 : 0.0, corner.corner == 1 ? 1.0 : 0.0};
}

LatticePoint lattice_point(const DomainPoint& p) {
  const std::int64_t a = to_lattice(p.alpha);
  const std::int64_t b = to_lattice(p.beta);
  return {b, kLatticeOne - a - b};
}

DomainPoint domain_point(DomainTriangleId triangle, LatticePoint p) {
  return {triangle, from_lattice(kLatticeOne - p.u - p.v), from_lattice(p.u)};
}

LatticePoint rotated(LatticePoint p, int sixths) {
  switch (((sixths % 6) + 6) % 6) {
    case 0:
      return p;
    case 1:
      return {-p.v, p.u + p.v};
    case 2:
      return {-p.u - p.v, p.u};
    case 3:
      return {-p.u, -p.v};
    case 4:
      return {p.v, -p.u - p.v};
    default:
      return {p.u + p.v, -p.u};
  }
}

LatticeMotion composed(const LatticeMotion& outer, const LatticeMotion& inner) {
  return {(outer.sixths + inner.sixths) % 6, rotated(inner.shift, outer.sixths) + outer.shift};
}

LatticeMotion inverse(const LatticeMotion& motion) {
  const int back = (6 - motion.sixths % 6) % 6;
  const LatticePoint shift = rotated(motion.shift, back);
  return {back, {-shift.u, -shift.v}};
}

LatticeMotion corner_frame(int corner) {
  if (corner == 0) return {};
  const LatticePoint origin = corner == 1 ? LatticePoint{kLatticeOne, 0} : LatticePoint{0, kLatticeOne};
  return inverse(LatticeMotion{2 * corner, origin});
}

LatticeMotion transition(int from_side, int to_side) {
  // In the frame along the shared side, the neighbour is turned by half a turn and starts at the side's other end.
  const LatticeMotion half_turn{3, {kLatticeOne, 0}};
  return composed(inverse(corner_frame(from_side)), composed(half_turn, corner_frame(to_side)));
}

Vec2d plane_point(LatticePoint p) {
  const double u = from_lattice(p.u);
  const double v = from_lattice(p.v);
  return {u + 0.5 * v, kHalfRoot3 * v};
}

LatticePoint nearest_lattice_point(Vec2d p) {
  const double v = p.y / kHalfRoot3;
  return {to_lattice(p.x - 0.5 * v), to_lattice(v)};
}

LatticeArea doubled_area(LatticePoint a, LatticePoint b, LatticePoint c) {
  const LatticePoint e = b - a;
  const LatticePoint f = c - a;
  return static_cast<LatticeArea>(e.u) * f.v - static_cast<LatticeArea>(e.v) * f.u;
}

}  // namespace lozenge
