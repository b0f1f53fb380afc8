// What a flip would gain is measured of all edges first; each is measured again before it is flipped.
#include "stages/parameterize/operations/heal_edges.h"

#include <algorithm>
#include <vector>

#include "stages/parameterize/operations/flip.h"

namespace lozenge {

int heal_overlong_edges(WorkingMap& map, const SurfaceMeasures& measures, Scratch& scratch) {
  struct Candidate {
    double gain;
    std::int32_t edge;
  };
  std::vector<Candidate> candidates;
  for_each_edge(map.domain, [&](DomainSide side) {
    if (!map.domain.neighbour(side).exists()) return;
    const double gain = flip_gain(map, measures, side);
    if (gain > 0) candidates.push_back({gain, 3 * side.triangle + side.side});
  });
  std::sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
    return a.gain != b.gain ? a.gain > b.gain : a.edge < b.edge;
  });
  int done = 0;
  for (const Candidate& c : candidates) {
    // A flip next to it may have changed what this one would gain.
    const DomainSide side{c.edge / 3, c.edge % 3};
    if (!can_flip(map, side) || flip_gain(map, measures, side) <= 0) continue;
    done += flip(map, side, kRelaxAround, scratch).has_value();
  }
  return done;
}

}  // namespace lozenge
