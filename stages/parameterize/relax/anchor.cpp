// A regular domain vertex needs no source vertex pinned to it, until an operation is about to make a cone of it. Its
// star is laid out, and mapped back with the nearest vertex in its centre.
#include "stages/parameterize/relax/anchor.h"

#include "stages/parameterize/map/local_change.h"
#include "stages/parameterize/map/star.h"
#include "stages/parameterize/relax/star_embedding.h"

namespace lozenge {

bool ensure_anchor(WorkingMap& map, DomainVertex n, Scratch& scratch) {
  constexpr std::size_t kMostTried = 3;  // nearest first; each costs an embedding
  // The operation that follows relaxes, and more.
  constexpr RelaxOptions kShort{2, 0};
  if (map.anchor[n] >= 0) return true;
  const std::vector<DomainCorner> star = star_of(map, n);
  const StarLayout layout = lay_out_star(map, star, {});
  return carry_out(map, scratch, [&](LocalChange& change) {
    if (!change.open(region_of(map, star, layout))) return false;
    change.keep_domain_vertex(n);
    const auto nearest = nearest_in_layout(map, polygon_of(map, star), layout, {0, 0}, kMostTried);
    return change.carry_out_first(nearest, [&](std::size_t i) {
      return embed_star(change, n, layout, layout.at[i], layout.vertices[i], kShort);
    });
  });
}

bool ensure_anchor_if_regular(WorkingMap& map, DomainVertex n, Scratch& scratch) {
  return !valence(map, n).is_regular() || ensure_anchor(map, n, scratch);
}

}  // namespace lozenge
