#include "stages/parameterize/domain_search.h"

#include <algorithm>
#include <vector>

#include "stages/parameterize/flip.h"
#include "stages/parameterize/global_optimization.h"
#include "stages/parameterize/snapshot.h"
#include "stages/parameterize/star_embedding.h"

namespace lozenge {

namespace {

constexpr RelaxOptions kSettle{5, 1e-2};

/// The least gain in evenness that is tried: of small domains, even flips that make valences less even, for there a
/// cone has few places to go.
int least_gain(const WorkingMap& map) { return map.domain_faces <= map.small_domain ? -2 : 0; }

/// The sides whose flips are tried, those first that gain most.
std::vector<DomainSide> candidates(const WorkingMap& map) {
  struct Candidate {
    int gain;
    DomainSide side;
  };
  std::vector<Candidate> found;
  for (DomainTriangleId t = 0; t < map.domain.size(); ++t) {
    for (int s = 0; s < 3; ++s) {
      const DomainSide side{t, s};
      if (map.domain.corner(t, 0) < 0 || map.domain.neighbour(side).triangle < t || !can_flip(map, side)) continue;
      if (const int gain = evenness_gain(map, side); gain >= least_gain(map)) found.push_back({gain, side});
    }
  }
  std::stable_sort(found.begin(), found.end(), [](const Candidate& a, const Candidate& b) { return a.gain > b.gain; });
  std::vector<DomainSide> sides;
  for (const Candidate& c : found) sides.push_back(c.side);
  return sides;
}

bool is_still_candidate(const WorkingMap& map, DomainSide side) {
  return map.domain.corner(side.triangle, 0) >= 0 && can_flip(map, side) && evenness_gain(map, side) >= least_gain(map);
}

/// Most flips gain nothing: those that do, found out on copies.
std::vector<DomainSide> those_that_gain(const WorkingMap& map, const std::vector<DomainSide>& sides,
                                        TrialCopies& copies) {
  std::vector<char> gains(sides.size(), 0);
  copies.run(map, {}, sides.size(), false, [&](TrialCopies::Copy& copy, std::size_t i) {
    Checkpoint undo(copy.map);
    gains[i] = flip_if_better(copy.map, sides[i], kSettle, undo) > 0;
    if (gains[i]) undo.restore();
  });
  std::vector<DomainSide> found;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    if (gains[i]) found.push_back(sides[i]);
  }
  return found;
}

/// Carries out the flips that gain, one after the other. \return how many
int flip_those_that_gain(WorkingMap& map, const std::vector<DomainSide>& sides) {
  return static_cast<int>(std::count_if(sides.begin(), sides.end(), [&](DomainSide side) {
    return is_still_candidate(map, side) && flip_if_better(map, side, kSettle) > 0;
  }));
}

/// The edges of the star of `n` and its rim whose flips are tried.
std::vector<DomainSide> candidates_around(const WorkingMap& map, DomainVertex n) {
  std::vector<DomainSide> sides;
  for (const DomainCorner& c : star_of(map, n)) {
    for (int s = 0; s < 2; ++s) {
      const DomainSide side{c.triangle, (c.corner + s) % 3};
      if (is_still_candidate(map, side)) sides.push_back(side);
    }
  }
  return sides;
}

/// Flips, relaxes everything, and goes back where the energy is not lower then.
bool flip_and_judge_all(WorkingMap& map, DomainSide side) {
  const GlobalOptions settle{3, 2e-2, 6, true, Cones::kInTheirStars};
  const double before = total_energy(map);
  const Snapshot snapshot = take_snapshot(map);
  if (flip(map, side, kSettle)) {
    free_regular_vertices(map);
    const double after = optimize_globally(map, settle).back();
    if (after < before - 1e-3 * (before - 1)) return true;
  }
  go_back(map, snapshot);
  return false;
}

}  // namespace

int improve_domain(WorkingMap& map) {
  const bool small = map.domain_faces <= map.small_domain;
  const int rounds = small ? 6 : 2;
  TrialCopies copies;
  int kept = 0;
  for (int round = 0; round < rounds; ++round) {
    optimize_globally(map, {small ? 6 : 1, 1e-2, 6, true, Cones::kInTheirStars});
    const std::vector<DomainSide> sides = candidates(map);
    int now = 0;
    if (small) {
      for (const DomainSide side : sides) now += is_still_candidate(map, side) && flip_and_judge_all(map, side);
    } else {
      now = flip_those_that_gain(map, those_that_gain(map, sides, copies));
    }
    kept += now;
    if (now == 0) break;
  }
  return kept;
}

namespace {

/// The vertex and its neighbours.
std::vector<DomainVertex> vertices_around(const WorkingMap& map, DomainVertex n) {
  std::vector<DomainVertex> vertices{n};
  for (const DomainCorner& c : star_of(map, n)) vertices.push_back(map.domain.corner(c.triangle, (c.corner + 1) % 3));
  return vertices;
}

int improve_by(WorkingMap& map, const std::vector<DomainSide>& flips, DomainVertex n) {
  const std::vector<DomainVertex> vertices = vertices_around(map, n);
  const int kept = flip_those_that_gain(map, flips);
  for (const DomainVertex v : vertices) {
    if (!valence(map, v).is_regular()) optimize_cone(map, v, {3, 1e-2});
  }
  return kept;
}

}  // namespace

int improve_domain_around(WorkingMap& map, DomainVertex n) { return improve_by(map, candidates_around(map, n), n); }

int improve_domain_around(WorkingMap& map, DomainVertex n, TrialCopies& copies) {
  return improve_by(map, those_that_gain(map, candidates_around(map, n), copies), n);
}

}  // namespace lozenge
