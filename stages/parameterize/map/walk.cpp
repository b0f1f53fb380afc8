// A line leaves a triangle over the side that it meets first; the rest of it is taken into the frame beyond, and so on
// until its end lies inside.
#include "stages/parameterize/map/walk.h"

#include <algorithm>
#include <limits>

namespace lozenge {

SideCrossed first_side_on(const Vec2d& from, const Vec2d& to) {
  // A point on a side must not be outside of both of its triangles.
  constexpr double kInside = -1e-13;
  const auto end = barycentrics(to);
  SideCrossed first{-1, std::numeric_limits<double>::infinity()};
  if (end[0] >= kInside && end[1] >= kInside && end[2] >= kInside) return first;
  const auto start = barycentrics(from);
  for (int c = 0; c < 3; ++c) {
    if (end[c] >= kInside) continue;
    const double inside = std::max(start[c], 0.0);
    const double along = inside / (inside - end[c]);
    if (along < first.along) first = {(c + 1) % 3, along};
  }
  return first;
}

std::optional<LineEnd> walk(const Domain& domain, DomainTriangleId frame, Vec2d from, Vec2d to) {
  LineEnd result{frame, to, {}};
  for (int step = 0; step < kMostTriangles; ++step) {
    const SideCrossed crossed = first_side_on(from, result.at);
    if (crossed.side < 0) return result;
    const DomainSide n = domain.neighbour({result.home, crossed.side});
    if (!n.exists()) return std::nullopt;
    const UnitMotion& across = unit_transition(n.side, crossed.side);
    from = across(from + (result.at - from) * crossed.along);
    result = {n.triangle, across(result.at), composed(result.back, unit_transition(crossed.side, n.side))};
  }
  return std::nullopt;
}

}  // namespace lozenge
