// An edge is known by its diamond: where one of the four corners is another one, it was something else that was tried.
#include "stages/parameterize/search/known_rises.h"

#include "stages/parameterize/map/star.h"

namespace lozenge {

namespace {

/// The diamond's four corners; on the boundary half of one.
std::array<DomainVertex, 4> diamond(const Domain& domain, DomainSide side) {
  const DomainSide across = domain.neighbour(side);
  return {domain.start(side), domain.end(side), domain.corner(side.triangle, (side.side + 2) % 3),
          across.exists() ? domain.corner(across.triangle, (across.side + 2) % 3) : -1};
}

}  // namespace

void KnownRises::find_out(const WorkingMap& map, const SurfaceMeasures& measures, const std::vector<DomainSide>& sides,
                          const Operation& operation, TrialCopies& copies, bool& fresh) {
  edges_.resize(map.domain.triangles.size() * 3);
  std::vector<DomainSide> unknown;
  for (const DomainSide side : sides) {
    const std::array<DomainVertex, 4> corners = diamond(map.domain, side);
    Edge& edge = edges_[edge_number(map.domain, side)];
    if (edge.corners == corners) continue;
    edge = {corners, std::nullopt};
    unknown.push_back(side);
  }
  if (unknown.empty()) return;
  copies.run(map, measures, unknown.size(), fresh, [&](TrialCopy& copy, std::size_t i) {
    edges_[edge_number(map.domain, unknown[i])].rise = rise_on_trial(copy, unknown[i], operation);
  });
  fresh = true;
}

std::optional<double> KnownRises::of(const Domain& domain, DomainSide side) const {
  return edges_[edge_number(domain, side)].rise;
}

void KnownRises::forget_near(const WorkingMap& map, DomainVertex n) {
  edges_.resize(map.domain.triangles.size() * 3);
  for (const DomainCorner& c : star_of(map, n)) {
    for (int other = 1; other < 3; ++other) {
      for (const DomainCorner& d : star_of(map, map.domain.corner(c.triangle, (c.corner + other) % 3))) {
        for (int s = 0; s < 3; ++s) edges_[edge_number(map.domain, {d.triangle, s})] = {};
      }
    }
  }
}

}  // namespace lozenge
