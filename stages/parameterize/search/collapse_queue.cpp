// An edge goes by its number. What changes its cost pushes it again with a later version, and entries of earlier ones
// are passed over when they come to the front.
#include "stages/parameterize/search/collapse_queue.h"

#include "stages/parameterize/map/star.h"
#include "stages/parameterize/operations/collapse.h"

namespace lozenge {

void CollapseQueue::rebuild(const WorkingMap& map, const SurfaceMeasures& measures) {
  entries_ = {};
  version_.assign(map.domain.triangles.size() * 3, 0);
  for_each_edge(map.domain, [&](DomainSide side) { push(map, measures, side); });
}

void CollapseQueue::push(const WorkingMap& map, const SurfaceMeasures& measures, DomainSide side) {
  const std::int32_t edge = edge_number(map.domain, side);
  entries_.push({collapse_cost(map, measures, side), edge, ++version_[edge]});
}

void CollapseQueue::update_star(const WorkingMap& map, const SurfaceMeasures& measures, DomainVertex n) {
  for (const DomainCorner& c : star_of(map, n)) {
    push(map, measures, {c.triangle, c.corner});
    push(map, measures, {c.triangle, (c.corner + 1) % 3});
    const DomainSide arriving{c.triangle, (c.corner + 2) % 3};
    if (!map.domain.neighbour(arriving).exists()) push(map, measures, arriving);
  }
}

std::optional<DomainSide> CollapseQueue::pop(const WorkingMap& map) {
  while (!entries_.empty()) {
    const Entry e = entries_.top();
    entries_.pop();
    const DomainSide side{e.edge / 3, e.edge % 3};
    if (version_[e.edge] == e.version && map.domain.corner(side.triangle, 0) >= 0 &&
        edge_number(map.domain, side) == e.edge) {
      return side;
    }
  }
  return std::nullopt;
}

}  // namespace lozenge
