#include "stages/parameterize/relocation.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "stages/parameterize/collapse.h"
#include "stages/parameterize/domain_search.h"
#include "stages/parameterize/global_optimization.h"
#include "stages/parameterize/snapshot.h"
#include "stages/parameterize/split.h"

namespace lozenge {

namespace {

/// Around a split.
constexpr RelaxOptions kSettle{4, 1e-2};

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

/// Rates each by what it raises the energy by, tried out and taken back, least first; what can't be done comes last.
template <typename Try>
void rate_by_trial(WorkingMap& map, std::vector<Rated>& rated, Try&& attempt) {
  for (Rated& r : rated) {
    Checkpoint undo(map);
    r.rating = std::numeric_limits<double>::infinity();
    double rise = 0;
    if (!attempt(r.side, undo, rise)) continue;
    undo.restore();
    r.rating = rise;
  }
  std::sort(rated.begin(), rated.end());
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
  rate_by_trial(map, splits, [&](DomainSide side, Checkpoint& undo, double& rise) {
    return split(map, side, kSettle, undo, rise) >= 0;
  });
  return splits;
}

/// Of the cheapest collapses, the one that raises the energy least, carried out.
bool collapse_best_of_cheapest(WorkingMap& map, SurfaceMeasures& measures) {
  constexpr std::size_t kTried = 16;
  const CollapseOptions options{{5, 1e-2}, false};
  std::vector<Rated> collapses = least_rated(
      map, kTried, [&](DomainSide side) { return can_collapse(map, side); },
      [&](DomainSide side) { return collapse_cost(map, measures, side); });
  rate_by_trial(map, collapses, [&](DomainSide side, Checkpoint& undo, double& rise) {
    return collapse(map, measures, side, options, undo, rise);
  });
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
      const DomainVertex n = split(map, splits[failures].side, kSettle, undo, rise);
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

}  // namespace lozenge
