#include "stages/parameterize/search/relocation.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>
#include <vector>

#include "formats/base/parallel.h"
#include "stages/parameterize/operations/collapse.h"
#include "stages/parameterize/operations/split.h"
#include "stages/parameterize/relax/global_optimization.h"
#include "stages/parameterize/relax/trials.h"
#include "stages/parameterize/search/domain_search.h"

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
  for_each_edge(map.domain, [&](DomainSide side) {
    if (is_possible(side)) rated.push_back({rate(side), side});
  });
  std::sort(rated.begin(), rated.end());
  rated.resize(std::min(most, rated.size()));
  return rated;
}

/// Rates each by what it raises the energy by, tried out and taken back, least first; what can't be done comes last.
void rate_by_trial(const WorkingMap& map, const SurfaceMeasures& measures, std::vector<Rated>& rated,
                   const Attempt& attempt) {
  TrialCopies copies;
  copies.run(map, measures, rated.size(), false, [&](TrialCopies::Copy& copy, std::size_t i) {
    constexpr double kImpossible = std::numeric_limits<double>::infinity();
    rated[i].rating = rise_on_trial(copy, rated[i].side, attempt).value_or(kImpossible);
  });
  std::sort(rated.begin(), rated.end());
}

/// [domain triangle] by how much the energy of the source triangles that begin there is above an isometry's.
std::vector<double> energy_excess(const WorkingMap& map) {
  std::vector<double> excess(map.domain.triangles.size(), 0.0);
  for (TriangleId t = 0; t < map.mesh.triangle_count(); ++t) {
    if (map.mesh.removed(t)) continue;
    excess[map.home[map.mesh.triangles[t][0]]] += triangle_energy(map, t) - map.rest[t].share;
  }
  return excess;
}

/// Splits of the edges between the largest regions, and between those of the most energy, by what they lower the
/// energy by, best first.
std::vector<Rated> best_splits(const WorkingMap& map, const SurfaceMeasures& measures) {
  constexpr std::size_t kOfLargest = 12;
  constexpr std::size_t kOfWorst = 8;
  const auto possible = [&](DomainSide side) { return can_split(map, side); };
  const auto sum_of_both = [&map](const auto& number) {
    return [&map, number](DomainSide side) {
      return -number(side.triangle) - number(map.domain.neighbour(side).triangle);
    };
  };
  std::vector<Rated> splits = least_rated(
      map, kOfLargest, possible, sum_of_both([&](DomainTriangleId t) { return region_area(map, measures, t); }));
  const std::vector<double> excess = energy_excess(map);
  for (const Rated& worst :
       least_rated(map, kOfWorst, possible, sum_of_both([&](DomainTriangleId t) { return excess[t]; }))) {
    const auto is_same = [&](const Rated& other) { return other.side == worst.side; };
    if (std::none_of(splits.begin(), splits.end(), is_same)) splits.push_back(worst);
  }
  rate_by_trial(map, measures, splits, [&](TrialCopies::Copy& copy, DomainSide side, Checkpoint& undo, double& rise) {
    return split(copy.map, side, kSettle, undo, rise) >= 0;
  });
  return splits;
}

/// Of the cheapest collapses, the one that raises the energy least, carried out. \return what it made, or -1
DomainVertex collapse_best_of_cheapest(WorkingMap& map, SurfaceMeasures& measures) {
  constexpr std::size_t kTried = 16;
  const CollapseOptions options{{5, 1e-2}, false};
  std::vector<Rated> collapses = least_rated(
      map, kTried, [&](DomainSide side) { return can_collapse(map, side); },
      [&](DomainSide side) { return collapse_cost(map, measures, side); });
  rate_by_trial(map, measures, collapses,
                [&](TrialCopies::Copy& copy, DomainSide side, Checkpoint& undo, double& rise) {
                  return collapse(copy.map, copy.measures, side, options, undo, rise);
                });
  if (collapses.empty()) return -1;
  const DomainSide best = collapses.front().side;
  const DomainVertex n = surviving_vertex(map, best);
  return collapse(map, measures, best, options) ? n : -1;
}

/// A vertex more, in the middle of a side. \return false where none can be made
bool give_vertex(WorkingMap& map, DomainSide side) {
  Checkpoint undo(map);
  double rise = 0;
  const DomainVertex made = split(map, side, kSettle, undo, rise);
  if (made >= 0) improve_domain_around(map, made);
  return made >= 0;
}

/// A vertex less, where that raises the energy least. \return false where none can go
bool take_vertex(WorkingMap& map, SurfaceMeasures& measures) {
  const DomainVertex left = collapse_best_of_cheapest(map, measures);
  if (left < 0) return false;
  free_regular_vertices(map);
  improve_domain_around(map, left);
  free_regular_vertices(map);
  return true;
}

/// A few epochs in which cones stay: those near what was changed have moved already. \return the energy
double settle_between(WorkingMap& map, int epochs) {
  return optimize_globally(map, {epochs, 1e-2, 6, true, Cones::kStay}).back();
}

/// Less is gained by the relaxation alone when a vertex comes back to where it was taken from.
bool has_gained(double before, double after) {
  constexpr double kLeastGain = 2e-3;
  return after < before - kLeastGain * (before - 1);
}

/// Gives a vertex to a side, takes another one away, and settles. \return whether the energy is lower then
bool move_vertex_to(WorkingMap& map, SurfaceMeasures& measures, DomainSide side) {
  const double before = total_energy(map);
  if (!give_vertex(map, side) || !take_vertex(map, measures)) return false;
  return has_gained(before, settle_between(map, 2));
}

/// Gives several vertices first, each where it is best, and takes as many away then. \return whether the energy is
/// lower then
bool move_vertices(WorkingMap& map, SurfaceMeasures& measures, int count) {
  const double before = total_energy(map);
  for (int i = 0; i < count; ++i) {
    const std::vector<Rated> splits = best_splits(map, measures);
    if (splits.empty() || !give_vertex(map, splits.front().side)) return false;
  }
  free_regular_vertices(map);
  settle_between(map, 2);
  for (int i = 0; i < count; ++i) {
    if (!take_vertex(map, measures)) return false;
    settle_between(map, 1);
  }
  return has_gained(before, settle_between(map, 2));
}

/// Of several things to try, the first that gains, carried out. Two are tried at a time where there are threads for
/// them. \param attempt  (map, measures, i) -> whether it has gained \return false, with nothing changed, where none
/// does
template <typename Attempt>
bool carry_out_first(WorkingMap& map, SurfaceMeasures& measures, std::size_t count, Attempt&& attempt) {
  const std::size_t at_once = most_threads() > 1 ? 2 : 1;
  struct Moved {
    WorkingMap map;
    SurfaceMeasures measures;
    bool gained = false;
  };
  for (std::size_t first = 0; first < count; first += at_once) {
    std::vector<Moved> moved(std::min(at_once, count - first));
    for_each_index(moved.size(), true, [&](std::size_t i) {
      moved[i] = {map, measures, false};
      moved[i].gained = attempt(moved[i].map, moved[i].measures, first + i);
    });
    for (Moved& m : moved) {
      if (!m.gained) continue;
      map = std::move(m.map);
      measures = std::move(m.measures);
      return true;
    }
  }
  return false;
}

/// One vertex, to one of the best places for it.
bool move_one(WorkingMap& map, SurfaceMeasures& measures) {
  constexpr std::size_t kMostTried = 4;
  const std::vector<Rated> splits = best_splits(map, measures);
  return carry_out_first(map, measures, std::min(kMostTried, splits.size()),
                         [&](WorkingMap& copy, SurfaceMeasures& copied, std::size_t i) {
                           return move_vertex_to(copy, copied, splits[i].side);
                         });
}

/// Several, where none gains on its own.
bool move_several(WorkingMap& map, SurfaceMeasures& measures) {
  constexpr std::array<int, 2> kCounts{3, 2};
  return carry_out_first(map, measures, kCounts.size(), [&](WorkingMap& copy, SurfaceMeasures& copied, std::size_t i) {
    return move_vertices(copy, copied, kCounts[i]);
  });
}

}  // namespace

int relocate_vertices(WorkingMap& map, SurfaceMeasures& measures, int most_moves) {
  constexpr int kMostOfSeveral = 4;
  int moves = 0;
  while (moves < most_moves && move_one(map, measures)) ++moves;
  for (int i = 0; i < kMostOfSeveral && move_several(map, measures); ++i) ++moves;
  return moves;
}

}  // namespace lozenge
