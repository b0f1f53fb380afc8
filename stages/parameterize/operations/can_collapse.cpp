// The ends may share no neighbours but those opposite the side, which must not be left with too few triangles; and what
// lies on the boundary stays there.
#include "stages/parameterize/operations/can_collapse.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "stages/parameterize/map/star.h"
#include "stages/parameterize/operations/fans.h"

namespace lozenge {

namespace {

/// The vertices that sides join to `n`, as often as they do.
std::vector<DomainVertex> neighbours_of(const WorkingMap& map, DomainVertex n) {
  std::vector<DomainVertex> found;
  const std::vector<DomainCorner> star = star_of(map, n);
  const auto corner = [&](const DomainCorner& c, int i) { return map.domain.corner(c.triangle, (c.corner + i) % 3); };
  for (const DomainCorner& c : star) found.push_back(corner(c, 1));
  if (next_around(map.domain, star.back()).triangle < 0) found.push_back(corner(star.back(), 2));
  return found;
}

/// The ends have no neighbours in common but those opposite the side, and no other side joins them.
bool fulfils_link_condition(const WorkingMap& map, const Fans& fans, const std::vector<DomainVertex>& opposite) {
  const auto without = [](std::vector<DomainVertex> vertices, DomainVertex n) {
    const auto found = std::find(vertices.begin(), vertices.end(), n);
    if (found != vertices.end()) vertices.erase(found);
    return vertices;
  };
  std::vector<DomainVertex> of_a = without(neighbours_of(map, fans.a), fans.b);
  std::vector<DomainVertex> of_b = without(neighbours_of(map, fans.b), fans.a);
  for (const DomainVertex n : opposite) {
    of_a = without(std::move(of_a), n);
    of_b = without(std::move(of_b), n);
  }
  return std::find(of_a.begin(), of_a.end(), fans.b) == of_a.end() &&
         std::none_of(of_b.begin(), of_b.end(),
                      [&](DomainVertex n) { return std::find(of_a.begin(), of_a.end(), n) != of_a.end(); });
}

/// A collapse along a side takes nothing from the boundary's other sides, and no user's cone from where it is.
bool keeps_boundary(const WorkingMap& map, const Fans& fans) {
  if (!fans.on_boundary) return true;
  if (fans.across.exists()) {
    if (fans.a_on_boundary && fans.b_on_boundary) return false;
    return map.kept[fans.a_on_boundary ? fans.b : fans.a] == 0;
  }
  // An ear's tip has no triangle but the one that vanishes.
  return count_slices(fans, true) > 0 && count_slices(fans, false) > 0;
}

}  // namespace

bool can_collapse(const WorkingMap& map, DomainSide side) {
  const Fans fans = find_fans(map, side);
  if (map.kept[fans.a] && map.kept[fans.b]) return false;
  if (!keeps_boundary(map, fans)) return false;
  // A half polygon of one slice is flat.
  const int least = fans.on_boundary ? 2 : 3;
  if (fans.count() < least || fans.count() > (fans.on_boundary ? kMostValenceOnBoundary : kMostValence)) return false;
  std::vector<DomainVertex> opposite{map.domain.corner(side.triangle, (side.side + 2) % 3)};
  if (fans.across.exists()) {
    opposite.push_back(map.domain.corner(fans.across.triangle, (fans.across.side + 2) % 3));
    if (opposite[0] == opposite[1]) return false;
  }
  for (const DomainVertex n : opposite) {
    if (const Valence v = valence(map, n); v.triangles <= v.least()) return false;
  }
  return fulfils_link_condition(map, fans, opposite);
}

}  // namespace lozenge
