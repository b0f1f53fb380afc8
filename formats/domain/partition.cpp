#include "formats/domain/partition.h"

#include <algorithm>

namespace lozenge {

namespace {

DomainVertex half_star_of(const Domain& domain, DomainTriangleId triangle, const std::array<double, 3>& weights) {
  const auto largest = std::max_element(weights.begin(), weights.end()) - weights.begin();
  return domain.corner(triangle, static_cast<int>(largest));
}

/// The lower side of its edge, so that both triangles give it the same.
DomainSide half_diamond_of(const Domain& domain, DomainTriangleId triangle, const std::array<double, 3>& weights) {
  const auto smallest = static_cast<int>(std::min_element(weights.begin(), weights.end()) - weights.begin());
  const DomainSide side{triangle, (smallest + 1) % 3};
  const DomainSide across = domain.neighbour(side);
  const bool lower = std::array{side.triangle, side.side} < std::array{across.triangle, across.side};
  return lower || !across.exists() ? side : across;
}

}  // namespace

std::int32_t part_of(const Domain& domain, DomainTriangleId triangle, const std::array<double, 3>& weights,
                     Partition partition) {
  if (partition == Partition::kFaces) return triangle;
  if (partition == Partition::kHalfStars) return half_star_of(domain, triangle, weights);
  const DomainSide side = half_diamond_of(domain, triangle, weights);
  return 3 * side.triangle + side.side;
}

std::int32_t part_of(const Domain& domain, const DomainPoint& p, Partition partition) {
  return part_of(domain, p.triangle, {p.alpha, p.beta, p.gamma()}, partition);
}

}  // namespace lozenge
