#include "stages/parameterize/plane_motion.h"

#include "formats/domain_point.h"

namespace lozenge {

namespace {

PlaneMotion in_the_plane(const LatticeMotion& motion) {
  const Vec2d axis = turned({1, 0}, motion.sixths);
  const Vec2d shift = plane_point(motion.shift);
  return {axis.x, axis.y, shift.x, shift.y};
}

std::array<PlaneMotion, 9> all_transitions() {
  std::array<PlaneMotion, 9> table;
  for (int from = 0; from < 3; ++from) {
    for (int to = 0; to < 3; ++to) table[3 * from + to] = in_the_plane(transition(from, to));
  }
  return table;
}

}  // namespace

const PlaneMotion& plane_transition(int from_side, int to_side) {
  static const std::array<PlaneMotion, 9> table = all_transitions();
  return table[3 * from_side + to_side];
}

}  // namespace lozenge
