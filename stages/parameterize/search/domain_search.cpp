// Flips are tried in the order of what they do to the valences, those that even them most first; each that is kept
// changes what its neighbours would, so every one is asked again when its turn comes.
#include "stages/parameterize/search/domain_search.h"

#include <algorithm>
#include <vector>

#include "stages/parameterize/map/map_energy.h"
#include "stages/parameterize/map/star.h"
#include "stages/parameterize/operations/flip.h"
#include "stages/parameterize/relax/cones.h"
#include "stages/parameterize/relax/global_optimization.h"
#include "stages/parameterize/search/efforts.h"

namespace lozenge {

namespace {

struct Candidate {
  int gain;
  DomainSide side;
};

/// The least gain in evenness that is tried: of small domains, even flips that make valences less even, for there a
/// cone has few places to go.
int least_gain(const WorkingMap& map) { return map.domain_faces <= map.small_domain ? -2 : 0; }

std::vector<Candidate> candidates(const WorkingMap& map) {
  std::vector<Candidate> found;
  for_each_edge(map.domain, [&](DomainSide side) {
    if (!can_flip(map, side)) return;
    if (const int gain = evenness_gain(map, side); gain >= least_gain(map)) found.push_back({gain, side});
  });
  std::stable_sort(found.begin(), found.end(), [](const Candidate& a, const Candidate& b) { return a.gain > b.gain; });
  return found;
}

bool is_still_candidate(const WorkingMap& map, DomainSide side) {
  return map.domain.corner(side.triangle, 0) >= 0 && can_flip(map, side) && evenness_gain(map, side) >= least_gain(map);
}

/// Flips and relaxes everything on a copy, which becomes the map where its energy is lower.
bool flip_and_judge_all(WorkingMap& map, DomainSide side, Scratch& scratch) {
  const double before = total_energy(map);
  WorkingMap trial = map;
  if (!flip(trial, side, kRelaxAround, scratch)) return false;
  free_regular_vertices(trial);
  const double after = optimize_globally(trial, effort_to_judge(true)).back();
  if (!(after < before - kLeastGainOfFlip * (before - 1))) return false;
  map = std::move(trial);
  return true;
}

}  // namespace

int improve_domain(WorkingMap& map, Scratch& scratch) {
  const bool small = map.domain_faces <= map.small_domain;
  const int rounds = small ? 6 : 2;
  const int epochs = small ? 6 : 1;
  int kept = 0;
  for (int round = 0; round < rounds; ++round) {
    optimize_globally(map, effort_before_flips(epochs));
    int now = 0;
    for (const Candidate& c : candidates(map)) {
      if (!is_still_candidate(map, c.side)) continue;
      now += small ? flip_and_judge_all(map, c.side, scratch)
                   : flip_if_better(map, c.side, kRelaxAround, scratch).has_value();
    }
    kept += now;
    if (now == 0) break;
  }
  return kept;
}

int improve_domain_around(WorkingMap& map, DomainVertex n, Scratch& scratch) {
  std::vector<DomainSide> sides;
  std::vector<DomainVertex> vertices{n};
  for (const DomainCorner& c : star_of(map, n)) {
    for (int s = 0; s < 2; ++s) sides.push_back({c.triangle, (c.corner + s) % 3});
    vertices.push_back(map.domain.corner(c.triangle, (c.corner + 1) % 3));
  }
  int kept = 0;
  for (const DomainSide side : sides) {
    if (is_still_candidate(map, side)) kept += flip_if_better(map, side, kRelaxAround, scratch).has_value();
  }
  for (const DomainVertex v : vertices) {
    if (!valence(map, v).is_regular()) optimize_cone(map, v, kRelaxStar, scratch);
  }
  return kept;
}

}  // namespace lozenge
