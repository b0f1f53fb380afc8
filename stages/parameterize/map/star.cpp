// Turning from corner to corner, counter-clockwise; on the boundary both ways from the corner that is known.
#include "stages/parameterize/map/star.h"

namespace lozenge {

std::vector<DomainCorner> star_of(const WorkingMap& map, DomainVertex v) {
  const DomainCorner first = map.corner_of[v];
  std::vector<DomainCorner> star = corners_around(map.domain, first);
  if (next_around(map.domain, star.back()).triangle >= 0) return star;
  std::vector<DomainCorner> before;
  for (DomainCorner c = previous_around(map.domain, first); c.triangle >= 0; c = previous_around(map.domain, c)) {
    before.push_back(c);
  }
  star.insert(star.begin(), before.rbegin(), before.rend());
  return star;
}

Valence valence(const WorkingMap& map, DomainVertex v) {
  const DomainCorner first = map.corner_of[v];
  Valence found;
  DomainCorner c = first;
  do {
    ++found.triangles;
    c = next_around(map.domain, c);
  } while (!(c == first) && c.triangle >= 0);
  if (c == first) return found;
  found.on_boundary = true;
  for (c = previous_around(map.domain, first); c.triangle >= 0; c = previous_around(map.domain, c)) ++found.triangles;
  return found;
}

}  // namespace lozenge
