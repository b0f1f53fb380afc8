// The exact motions of the lattice, in units of a triangle's side, tabulated once.
#include "stages/parameterize/map/plane_motion.h"

#include "formats/domain/domain_point.h"

namespace lozenge {

namespace {

UnitMotion in_unit_steps(const LatticeMotion& motion) {
  const UnitPoint shift{static_cast<std::int16_t>(motion.shift.u / kLatticeOne),
                        static_cast<std::int16_t>(motion.shift.v / kLatticeOne)};
  return composed({0, shift}, rotation(motion.sixths));
}

std::array<UnitMotion, 9> all_transitions() {
  std::array<UnitMotion, 9> table;
  for (int from = 0; from < 3; ++from) {
    for (int to = 0; to < 3; ++to) table[3 * from + to] = in_unit_steps(transition(from, to));
  }
  return table;
}

std::array<UnitMotion, 3> all_corner_frames() {
  return {in_unit_steps(corner_frame(0)), in_unit_steps(corner_frame(1)), in_unit_steps(corner_frame(2))};
}

}  // namespace

UnitMotion motion_of_segment(const Vec2d& p, const Vec2d& q, const Vec2d& to_p, const Vec2d& to_q) {
  constexpr double kSixth = 3.14159265358979323846 / 3;
  const Vec2d e = q - p;
  const Vec2d f = to_q - to_p;
  const double angle = std::atan2(cross(e, f), e.dot(f));
  const UnitMotion turn = rotation(static_cast<int>(std::lround(angle / kSixth)));
  const auto b = barycentrics(to_p - turn(p));
  return {turn.sixths, {static_cast<std::int16_t>(std::lround(b[1])), static_cast<std::int16_t>(std::lround(b[2]))}};
}

const UnitMotion& unit_transition(int from_side, int to_side) {
  static const std::array<UnitMotion, 9> table = all_transitions();
  return table[3 * from_side + to_side];
}

const UnitMotion& to_corner_frame(int corner) {
  static const std::array<UnitMotion, 3> table = all_corner_frames();
  return table[corner];
}

const UnitMotion& from_corner_frame(int corner) {
  static const std::array<UnitMotion, 3> table{inverse(to_corner_frame(0)), inverse(to_corner_frame(1)),
                                               inverse(to_corner_frame(2))};
  return table[corner];
}

}  // namespace lozenge
