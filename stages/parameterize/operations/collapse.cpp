// The two fans around the side become one star. What lies in them is laid out in the star's polygon with both ends
// inside of it; the domain is rewired; and the layout is mapped back around a new centre, one source vertex after
// another, until one leaves no fold.
#include "stages/parameterize/operations/collapse.h"

#include <algorithm>
#include <vector>

#include "stages/parameterize/map/pins.h"
#include "stages/parameterize/map/star.h"
#include "stages/parameterize/operations/collapse_layout.h"
#include "stages/parameterize/operations/fans.h"
#include "stages/parameterize/operations/new_centre.h"
#include "stages/parameterize/operations/warm_up.h"
#include "stages/parameterize/relax/anchor.h"
#include "stages/parameterize/relax/star_embedding.h"

namespace lozenge {

namespace {

/// Vertices pinned to the rim that are at home in a triangle that vanishes.
std::vector<VertexId> displaced_by(const WorkingMap& map, const Fans& fans) {
  std::vector<VertexId> displaced;
  for (const DomainTriangleId t : vanishing(fans)) {
    for (VertexId v = map.first_in[t]; v >= 0; v = map.next_in[v]) {
      const DomainVertex n = map.pin[v];
      if (n >= 0 && n != fans.a && n != fans.b) displaced.push_back(v);
    }
  }
  return displaced;
}

/// Keeps what `collapse_domain` changes.
void keep(LocalChange& change, const Fans& fans, const std::vector<VertexId>& displaced) {
  const Domain& domain = change.map().domain;
  for (const Slice& s : fans.slices) {
    for (int i = 0; i < 3; ++i) change.keep_domain_vertex(domain.corner(s.corner.triangle, i));
    change.keep_triangle(s.corner.triangle);
  }
  for (const DomainVertex n : {fans.a, fans.b}) change.keep_domain_vertex(n);
  for (const DomainTriangleId t : vanishing(fans)) change.keep_triangle(t);
  for (const VertexId v : displaced) change.keep_vertex(v);
}

/// Joins the two triangles across the other two sides of a triangle that vanishes.
void close_over(Domain& domain, DomainSide side) {
  const DomainSide p = domain.neighbour({side.triangle, (side.side + 1) % 3});
  const DomainSide q = domain.neighbour({side.triangle, (side.side + 2) % 3});
  if (p.exists()) domain.triangles[p.triangle].neighbours[p.side] = q;
  if (q.exists()) domain.triangles[q.triangle].neighbours[q.side] = p;
}

/// Carries out the collapse on the domain alone. Vertices pinned to a or b become free; those pinned to the rim find
/// another corner.
void collapse_domain(WorkingMap& map, const Fans& fans, const std::vector<VertexId>& displaced) {
  const std::vector<DomainTriangleId> gone = vanishing(fans);
  for (const DomainVertex n : {fans.a, fans.b}) {
    if (map.anchor[n] >= 0) unpin(map, map.anchor[n]);
  }
  close_over(map.domain, fans.side);
  if (fans.across.exists()) close_over(map.domain, fans.across);
  for (const DomainTriangleId t : gone) map.domain.triangles[t] = {};
  map.domain_faces -= static_cast<std::int32_t>(gone.size());
  for (const auto& [c, of_a] : fans.slices) map.domain.triangles[c.triangle].corners[c.corner] = fans.kept;
  for (const auto& [c, of_a] : fans.slices) {
    for (int i = 0; i < 3; ++i) map.corner_of[map.domain.corner(c.triangle, i)] = {c.triangle, i};
  }
  map.corner_of[fans.gone] = {};
  // Slice m of the layout starts at the polygon's corner m, and so must the star's first triangle.
  map.corner_of[fans.kept] = fans.slices.front().corner;
  for (const VertexId v : displaced) renew_pin(map, v);
}

std::size_t position_of(const StarLayout& layout, VertexId v) {
  return static_cast<std::size_t>(std::find(layout.vertices.begin(), layout.vertices.end(), v) -
                                  layout.vertices.begin());
}

/// Places in the layout of the vertices that the new star may have for its centre, the most promising first: a user's
/// cone stays where it is.
std::vector<std::size_t> centres_for(LocalChange& change, const SurfaceMeasures& measures, const Fans& fans,
                                     const StarLayout& layout, const Vec3d& embedded) {
  const WorkingMap& map = change.map();
  if (map.kept[fans.kept]) return {position_of(layout, map.anchor[fans.kept])};
  return rank_centres(map, measures, layout, fans.polygon(), embedded, change.scratch().places);
}

}  // namespace

DomainVertex surviving_vertex(const WorkingMap& map, DomainSide side) {
  return surviving_end(map, map.domain.start(side), map.domain.end(side));
}

double collapse_cost(const WorkingMap& map, const SurfaceMeasures& measures, DomainSide side) {
  const double length = path_length(map, measures, side);
  const DomainSide across = map.domain.neighbour(side);
  return region_area(map, measures, side.triangle) +
         (across.exists() ? region_area(map, measures, across.triangle) : 0) + length * length;
}

std::optional<double> collapse(LocalChange& change, SurfaceMeasures& measures, DomainSide side,
                               const CollapseOptions& options) {
  WorkingMap& map = change.map();
  for (const DomainSide s : {side, map.domain.neighbour(side)}) {
    if (!s.exists()) continue;
    const DomainVertex opposite = map.domain.corner(s.triangle, (s.side + 2) % 3);
    if (!ensure_anchor_if_regular(map, opposite, change.scratch())) return std::nullopt;
  }
  const Fans fans = find_fans(map, side);
  const StarLayout layout = lay_out_fans(map, fans, place_ends(map.energy, fans));
  if (layout.vertices.empty() || !change.open(region_of(map, fans, layout))) return std::nullopt;
  const Vec3d embedded = measures.warming_up ? embed_collapsed_vertex(map, measures, side) : Vec3d(0, 0, 0);
  const std::vector<VertexId> displaced = displaced_by(map, fans);
  keep(change, fans, displaced);
  change.measure_before(map.domain_faces - static_cast<std::int32_t>(vanishing(fans).size()));

  const auto embed = [&](std::size_t centre) {
    collapse_domain(map, fans, displaced);
    const bool pin = options.pin_regular || !valence(map, fans.kept).is_regular() || map.kept[fans.kept];
    return embed_star(change, fans.kept, layout, layout.at[centre], pin ? layout.vertices[centre] : -1, options.relax);
  };
  if (!change.carry_out_first(centres_for(change, measures, fans, layout, embedded), embed)) return std::nullopt;
  measures.embedding[fans.kept] = embedded;
  return change.rise();
}

std::optional<double> collapse(WorkingMap& map, SurfaceMeasures& measures, DomainSide side,
                               const CollapseOptions& options, Scratch& scratch) {
  return carry_out(map, scratch, [&](LocalChange& change) { return collapse(change, measures, side, options); });
}

}  // namespace lozenge
