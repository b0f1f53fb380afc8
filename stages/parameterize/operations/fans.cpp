// Around each end the triangles but those at the side, a's first; where one end lies on the boundary the star is half
// of one, and starts where the boundary leaves it.
#include "stages/parameterize/operations/fans.h"

#include <algorithm>

#include "stages/parameterize/map/star.h"

namespace lozenge {

namespace {

/// Of a side inside whose ends are a vertex inside and one on the boundary: around the latter up to the side, around
/// the other, and on.
void join_inside_to_boundary(const WorkingMap& map, Fans& fans) {
  const bool of_a = fans.a_on_boundary;  // the end on the boundary
  const std::vector<DomainCorner> outer = star_of(map, of_a ? fans.a : fans.b);
  const DomainSide from =
      of_a ? fans.side : fans.across;  // leaves the end on the boundary; the later of both triangles
  const DomainSide other = of_a ? fans.across : fans.side;
  const std::vector<DomainCorner> inner = corners_around(map.domain, {other.triangle, other.side});
  std::size_t later = 0;
  while (!(outer[later] == DomainCorner{from.triangle, from.side})) ++later;
  fans.add(outer, 0, later - 1, of_a);
  const int first = fans.count();
  fans.add(inner, 1, inner.size() - 1, !of_a);
  const int last = fans.count();
  fans.add(outer, later + 1, outer.size(), of_a);
  // Between the end inside and the slices of the one on the boundary there is one on either side.
  (of_a ? fans.shared_of_a : fans.shared_of_b) = {last, first};
  (of_a ? fans.shared_of_b : fans.shared_of_a) = {first, last};
}

}  // namespace

DomainVertex surviving_end(const WorkingMap& map, DomainVertex a, DomainVertex b) { return map.kept[b] ? b : a; }

Fans find_fans(const WorkingMap& map, DomainSide side) {
  Fans fans;
  fans.a = map.domain.start(side);
  fans.b = map.domain.end(side);
  fans.kept = surviving_end(map, fans.a, fans.b);
  fans.gone = fans.kept == fans.a ? fans.b : fans.a;
  fans.side = side;
  fans.across = map.domain.neighbour(side);
  fans.a_on_boundary = valence(map, fans.a).on_boundary;
  fans.b_on_boundary = valence(map, fans.b).on_boundary;
  fans.on_boundary = fans.a_on_boundary || fans.b_on_boundary;
  if (!fans.across.exists()) {
    const std::vector<DomainCorner> around_a = star_of(map, fans.a);
    const std::vector<DomainCorner> around_b = star_of(map, fans.b);
    fans.add(around_b, 0, around_b.size() - 1, false);
    fans.shared_of_b.behind = fans.shared_of_a.before = fans.count();
    fans.add(around_a, 1, around_a.size(), true);
  } else if (fans.on_boundary) {
    join_inside_to_boundary(map, fans);
  } else {
    const std::vector<DomainCorner> around_a = corners_around(map.domain, {side.triangle, side.side});
    const std::vector<DomainCorner> around_b = corners_around(map.domain, {fans.across.triangle, fans.across.side});
    fans.add(around_a, 1, around_a.size() - 1, true);
    const int between = fans.count();
    fans.add(around_b, 1, around_b.size() - 1, false);
    fans.shared_of_a = {0, between};
    fans.shared_of_b = {between, fans.count()};
  }
  return fans;
}

int count_slices(const Fans& fans, bool of_a) {
  return static_cast<int>(
      std::count_if(fans.slices.begin(), fans.slices.end(), [&](const Slice& s) { return s.of_a == of_a; }));
}

std::vector<DomainTriangleId> vanishing(const Fans& fans) {
  if (!fans.across.exists()) return {fans.side.triangle};
  return {fans.side.triangle, fans.across.triangle};
}

/// Both fans and what vanishes.

}  // namespace lozenge
