#include "stages/parameterize/relocation.h"

#include <tbb/task_arena.h>

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "stages/parameterize/collapse.h"
#include "stages/parameterize/domain_search.h"
#include "stages/parameterize/global_optimization.h"
#include "stages/parameterize/split.h"
#include "stages/parameterize/trials.h"

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
void rate_by_trial(const WorkingMap& map, const SurfaceMeasures& measures, std::vector<Rated>& rated, Try&& attempt) {
  TrialCopies copies;
  copies.run(map, measures, rated.size(), false, [&](TrialCopies::Copy& copy, std::size_t i) {
    Checkpoint undo(copy.map);
    rated[i].rating = std::numeric_limits<double>::infinity();
    double rise = 0;
    if (!attempt(copy, rated[i].side, undo, rise)) return;
    undo.restore();
    rated[i].rating = rise;
  });
  std::sort(rated.begin(), rated.end());
}

/// Splits of the edges between the largest regions, by what they lower the energy by, best first.
std::vector<Rated> best_splits(const WorkingMap& map, const SurfaceMeasures& measures) {
  constexpr std::size_t kTried = 12;
  std::vector<Rated> splits = least_rated(
      map, kTried, [&](DomainSide side) { return can_split(map, side); },
      [&](DomainSide side) {
        return -region_area(map, measures, side.triangle) -
               region_area(map, measures, map.domain.neighbour(side).triangle);
      });
  rate_by_trial(map, measures, splits, [&](TrialCopies::Copy& copy, DomainSide side, Checkpoint& undo, double& rise) {
    return split(copy.map, side, kSettle, undo, rise) >= 0;
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
  rate_by_trial(map, measures, collapses,
                [&](TrialCopies::Copy& copy, DomainSide side, Checkpoint& undo, double& rise) {
                  return collapse(copy.map, copy.measures, side, options, undo, rise);
                });
  return !collapses.empty() && collapse(map, measures, collapses.front().side, options);
}

/// Splits a side, collapses another one, and settles. \return whether the energy is lower then by more than a little
bool move_vertex_to(WorkingMap& map, SurfaceMeasures& measures, DomainSide side) {
  // Less is gained by the relaxation alone when a vertex comes back to where it was taken from.
  constexpr double kLeastGain = 5e-3;
  const GlobalOptions settle{2, 1e-2, 6, true, Cones::kInTheirStars};
  const double before = total_energy(map);
  Checkpoint undo(map);
  double rise = 0;
  const DomainVertex n = split(map, side, kSettle, undo, rise);
  if (n < 0) return false;
  improve_domain_around(map, n);
  if (!collapse_best_of_cheapest(map, measures)) return false;
  free_regular_vertices(map);
  return optimize_globally(map, settle).back() < before - kLeastGain * (before - 1);
}

/// Of the splits the first that gains, carried out. Two are tried at a time where there are threads for
/// them. \return false, with nothing changed, where none does
bool carry_out_first(WorkingMap& map, SurfaceMeasures& measures, const std::vector<Rated>& splits) {
  const std::size_t at_once = tbb::this_task_arena::max_concurrency() > 1 ? 2 : 1;
  struct Moved {
    WorkingMap map;
    SurfaceMeasures measures;
    bool gained = false;
  };
  for (std::size_t first = 0; first < splits.size(); first += at_once) {
    std::vector<Moved> moved(std::min(at_once, splits.size() - first));
    for_each_index(moved.size(), true, [&](std::size_t i) {
      moved[i] = {map, measures, false};
      moved[i].gained = move_vertex_to(moved[i].map, moved[i].measures, splits[first + i].side);
    });
    for (std::size_t i = 0; i < moved.size(); ++i) {
      if (!moved[i].gained) continue;
      map = std::move(moved[i].map);
      measures = std::move(moved[i].measures);
      return true;
    }
  }
  return false;
}

}  // namespace

int relocate_vertices(WorkingMap& map, SurfaceMeasures& measures, int most_moves) {
  constexpr std::size_t kMostTried = 4;
  int moves = 0;
  for (; moves < most_moves; ++moves) {
    std::vector<Rated> splits = best_splits(map, measures);
    splits.resize(std::min(kMostTried, splits.size()));
    if (!carry_out_first(map, measures, splits)) break;
  }
  return moves;
}

}  // namespace lozenge
