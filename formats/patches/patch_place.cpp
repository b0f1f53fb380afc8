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

}  // namespace lozenge
