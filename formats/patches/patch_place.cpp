#include "formats/patches/patch_place.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace lozenge {

DomainPoint domain_point_at(const PatchPlace& place, double u, double v) {
  // On either side of the edge the place is a mixture of a, b and that triangle's barycentre, whose weight is |v - u|.
  const bool left = v >= u;
  const double apex = std::abs(v - u) / 3;
  const double a = 1 - std::max(u, v) + apex;
  const double b = std::min(u, v) + apex;
  const DomainSide side = left ? place.left : place.right;
  std::array<double, 3> weights{};
  weights[side.side] = left ? a : b;
  weights[(side.side + 1) % 3] = left ? b : a;
  weights[(side.side + 2) % 3] = apex;
  return make_point(side.triangle, weights[0], weights[1]);
}

PlaceSteps steps_at(const PatchPlace& place, double u, double v) {
  const bool left = v >= u;
  const DomainSide side = left ? place.left : place.right;
  // Of a, b and the barycentre's corner, in thirds, as above.
  const std::array<Vec2d, 3> changes = left ? std::array{Vec2d(-1, -2), Vec2d(2, 1), Vec2d(-1, 1)}
                                            : std::array{Vec2d(-2, -1), Vec2d(1, 2), Vec2d(1, -1)};
  std::array<Vec2d, 3> weights;
  weights[side.side] = changes[left ? 0 : 1];
  weights[(side.side + 1) % 3] = changes[left ? 1 : 0];
  weights[(side.side + 2) % 3] = changes[2];
  return {Vec2d(weights[0].x, weights[1].x) / 3.0, Vec2d(weights[0].y, weights[1].y) / 3.0};
}

}  // namespace lozenge
