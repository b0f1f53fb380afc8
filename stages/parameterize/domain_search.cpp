#include "stages/parameterize/domain_search.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "stages/parameterize/collapse.h"
#include "stages/parameterize/flip.h"
#include "stages/parameterize/global_optimization.h"
#include "stages/parameterize/snapshot.h"
#include "stages/parameterize/split.h"
#include "stages/parameterize/star_embedding.h"

namespace lozenge {

namespace {

struct Candidate {
  int gain;
  DomainSide side;
};

/// The least gain in evenness that is tried: of small domains, even flips that make valences less even, for there a
/// cone has few places to go.
int least_gain(const WorkingMap& map) { return map.domain_faces <= kSmallDomain ? -2 : 0; }

std::vector<Candidate> candidates(const WorkingMap& map) {
  std::vector<Candidate> found;
  for (DomainTriangleId t = 0; t < map.domain.size(); ++t) {
    for (int s = 0; s < 3; ++s) {
      const DomainSide side{t, s};
      if (map.domain.corner(t, 0) < 0 || map.domain.neighbour(side).triangle < t || !can_flip(map, side)) continue;
      if (const int gain = evenness_gain(map, side); gain >= least_gain(map)) found.push_back({gain, side});
    }
  }
  std::stable_sort(found.begin(), found.end(), [](const Candidate& a, const Candidate& b) { return a.gain > b.gain; });
  return found;
}

bool is_still_candidate(const WorkingMap& map, DomainSide side) {
  return map.domain.corner(side.triangle, 0) >= 0 && can_flip(map, side) && evenness_gain(map, side) >= least_gain(map);
}

/// Flips, relaxes everything, and goes back where the energy is not lower then.
bool flip_and_judge_all(WorkingMap& map, DomainSide side) {
  const GlobalOptions settle{3, 2e-2, 6, true, Cones::kInTheirStars};
  const double before = total_energy(map);
  const Snapshot snapshot = take_snapshot(map);
  if (flip(map, side, {5, 1e-2})) {
    free_regular_vertices(map);
    const double after = optimize_globally(map, settle).back();
    if (after < before - 1e-3 * (before - 1)) return true;
  }
  go_back(map, snapshot);
  return false;
}

struct Rated {
  double rating;
  DomainSide side;
  bool operator<(const Rated& other) const {
    if (rating != other.rating) return rating < other.rating;
    return 3 * side.triangle + side.side < 3 * other.side.triangle + other.side.side;
  }
};

/// Every edge for which `is_possible`, by its rating, least first; at most `most`.
template <typename Possible, typename Rate>
std::vector<Rated> least_rated(const WorkingMap& map, std::size_t most, Possible&& is_possible, Rate&& rate) {
  std::vector<Rated> rated;
  for (DomainTriangleId t = 0; t < map.domain.size(); ++t) {
    for (int s = 0; s < 3 && map.domain.corner(t, 0) >= 0; ++s) {
      const DomainSide side{t, s};
      const DomainSide n = map.domain.neighbour(side);
      if (n.exists() && n.triangle < t) continue;
      if (is_possible(side)) rated.push_back({rate(side), side});
    }
  }
  std::sort(rated.begin(), rated.end());
  rated.resize(std::min(most, rated.size()));
  return rated;
}

/// Splits of the edges between the largest regions, by what they lower the energy by, best first.
std::vector<Rated> best_splits(WorkingMap& map, const SurfaceMeasures& measures) {
  constexpr std::size_t kTried = 12;
  std::vector<Rated> splits = least_rated(
      map, kTried, [&](DomainSide side) { return can_split(map, side); },
      [&](DomainSide side) {
        return -region_area(map, measures, side.triangle) -
               region_area(map, measures, map.domain.neighbour(side).triangle);
      });
  for (Rated& r : splits) {
    Checkpoint undo(map);
    r.rating = std::numeric_limits<double>::infinity();
    double rise = 0;
    if (split(map, r.side, {4, 1e-2}, undo, rise) < 0) continue;
    undo.restore();
    r.rating = rise;
  }
  std::sort(splits.begin(), splits.end());
  return splits;
}

/// Of the cheapest collapses, the one that raises the energy least, carried out.
bool collapse_best_of_cheapest(WorkingMap& map, SurfaceMeasures& measures) {
  constexpr std::size_t kTried = 16;
  const CollapseOptions options{{5, 1e-2}, false};
  std::vector<Rated> collapses = least_rated(
      map, kTried, [&](DomainSide side) { return can_collapse(map, side); },
      [&](DomainSide side) { return collapse_cost(map, measures, side); });
  for (Rated& r : collapses) {
    Checkpoint undo(map);
    r.rating = std::numeric_limits<double>::infinity();
    double rise = 0;
    if (!collapse(map, measures, r.side, options, undo, rise)) continue;
    undo.restore();
    r.rating = rise;
  }
  std::sort(collapses.begin(), collapses.end());
  return !collapses.empty() && collapse(map, measures, collapses.front().side, options);
}

}  // namespace

int relocate_vertices(WorkingMap& map, SurfaceMeasures& measures, int most_moves) {
  constexpr std::size_t kFailures = 4;
  // Less is gained by the relaxation alone when a vertex comes back to where it was taken from.
  constexpr double kLeastGain = 5e-3;
  const GlobalOptions settle{2, 1e-2, 6, true, Cones::kInTheirStars};
  int moves = 0;
  std::size_t failures = 0;
  while (moves < most_moves && failures < kFailures) {
    const std::vector<Rated> splits = best_splits(map, measures);
    const double before = total_energy(map);
    const Snapshot snapshot = take_snapshot(map);
    bool moved = false;
    for (; failures < std::min(kFailures, splits.size()) && !moved; ++failures) {
      Checkpoint undo(map);
      double rise = 0;
      const DomainVertex n = split(map, splits[failures].side, {4, 1e-2}, undo, rise);
      if (n >= 0) {
        improve_domain_around(map, n);
        moved = collapse_best_of_cheapest(map, measures);
        if (moved) free_regular_vertices(map);
        moved = moved && optimize_globally(map, settle).back() < before - kLeastGain * (before - 1);
      }
      if (!moved) go_back(map, snapshot);
    }
    if (!moved) break;
    failures = 0;
    ++moves;
  }
  return moves;
}

int improve_domain(WorkingMap& map) {
  const bool small = map.domain_faces <= kSmallDomain;
  const int rounds = small ? 6 : 2;
  int kept = 0;
  for (int round = 0; round < rounds; ++round) {
    optimize_globally(map, {small ? 6 : 1, 1e-2, 6, true, Cones::kInTheirStars});
    int now = 0;
    for (const Candidate& c : candidates(map)) {
      if (!is_still_candidate(map, c.side)) continue;
      now += small ? flip_and_judge_all(map, c.side) : flip_if_better(map, c.side, {5, 1e-2}) > 0;
    }
    kept += now;
    if (now == 0) break;
  }
  return kept;
}

int improve_domain_around(WorkingMap& map, DomainVertex n) {
  std::vector<DomainSide> sides;
  std::vector<DomainVertex> vertices{n};
  for (const DomainCorner& c : star_of(map, n)) {
    for (int s = 0; s < 2; ++s) sides.push_back({c.triangle, (c.corner + s) % 3});
    vertices.push_back(map.domain.corner(c.triangle, (c.corner + 1) % 3));
  }
  int kept = 0;
  for (const DomainSide side : sides) {
    if (is_still_candidate(map, side)) kept += flip_if_better(map, side, {5, 1e-2}) > 0;
  }
  for (const DomainVertex v : vertices) {
    if (valence(map, v) != 6) optimize_cone(map, v, {3, 1e-2});
  }
  return kept;
}

}  // namespace lozenge
