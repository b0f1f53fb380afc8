// A vertex is given by a split and taken by a collapse. Where either goes is decided by trying the most promising ones
// out on copies and taking them back; whether it was worth it, by the whole map when it has settled, on a copy as well.
#include "stages/parameterize/search/relocation.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>
#include <vector>

#include "formats/base/parallel.h"
#include "stages/parameterize/map/map_energy.h"
#include "stages/parameterize/operations/can_collapse.h"
#include "stages/parameterize/operations/collapse.h"
#include "stages/parameterize/operations/split.h"
#include "stages/parameterize/relax/global_optimization.h"
#include "stages/parameterize/relax/trials.h"
#include "stages/parameterize/search/domain_search.h"
#include "stages/parameterize/search/efforts.h"

namespace lozenge {

namespace {

/// Around a split, which leaves the map less far from settled than a collapse does.
constexpr RelaxOptions kRelaxSplit{4, 1e-2};

struct RatedSide {
  double rating;
  DomainSide side;
  bool operator<(const RatedSide& other) const {
    if (rating != other.rating) return rating < other.rating;
    return 3 * side.triangle + side.side < 3 * other.side.triangle + other.side.side;
  }
};

/// Every edge for which `is_possible`, by its rating, least first; at most `most`.
template <typename Possible, typename Rate>
std::vector<RatedSide> least_rated(const WorkingMap& map, std::size_t most, Possible&& is_possible, Rate&& rate) {
  std::vector<RatedSide> rated;
  for_each_edge(map.domain, [&](DomainSide side) {
    if (is_possible(side)) rated.push_back({rate(side), side});
  });
  std::sort(rated.begin(), rated.end());
  rated.resize(std::min(most, rated.size()));
  return rated;
}

/// Rates each by what it raises the energy by, tried out and taken back, least first; what can't be done comes last.
void rate_by_trial(const WorkingMap& map, const SurfaceMeasures& measures, std::vector<RatedSide>& rated,
                   const Operation& operation) {
  TrialCopies copies;
  copies.run(map, measures, rated.size(), false, [&](TrialCopy& copy, std::size_t i) {
    constexpr double kImpossible = std::numeric_limits<double>::infinity();
    rated[i].rating = rise_on_trial(copy, rated[i].side, operation).value_or(kImpossible);
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
std::vector<RatedSide> best_splits(const WorkingMap& map, const SurfaceMeasures& measures) {
  // Tried out are those that promise most by either measure: a trial costs a fraction of what follows.
  constexpr std::size_t kOfLargest = 12;
  constexpr std::size_t kOfWorst = 8;
  const auto possible = [&](DomainSide side) { return can_split(map, side); };
  const auto sum_of_both = [&map](const auto& number) {
    return [&map, number](DomainSide side) {
      return -number(side.triangle) - number(map.domain.neighbour(side).triangle);
    };
  };
  std::vector<RatedSide> splits = least_rated(
      map, kOfLargest, possible, sum_of_both([&](DomainTriangleId t) { return region_area(map, measures, t); }));
  const std::vector<double> excess = energy_excess(map);
  for (const RatedSide& worst :
       least_rated(map, kOfWorst, possible, sum_of_both([&](DomainTriangleId t) { return excess[t]; }))) {
    const auto is_same = [&](const RatedSide& other) { return other.side == worst.side; };
    if (std::none_of(splits.begin(), splits.end(), is_same)) splits.push_back(worst);
  }
  rate_by_trial(map, measures, splits, [](LocalChange& change, SurfaceMeasures&, DomainSide side) {
    const auto made = split(change, side, kRelaxSplit);
    return made ? std::optional<double>(made->rise) : std::nullopt;
  });
  return splits;
}

/// Of the cheapest collapses, the one that raises the energy least, carried out. \return what it made, or -1
DomainVertex collapse_best_of_cheapest(WorkingMap& map, SurfaceMeasures& measures, Scratch& scratch) {
  constexpr std::size_t kTried = 16;  // as in decimation: eight took 6 % less time, for 1.5 % more distortion
  const CollapseOptions options{kRelaxAround, false};
  std::vector<RatedSide> collapses = least_rated(
      map, kTried, [&](DomainSide side) { return can_collapse(map, side); },
      [&](DomainSide side) { return collapse_cost(map, measures, side); });
  rate_by_trial(map, measures, collapses, [&](LocalChange& change, SurfaceMeasures& copied, DomainSide side) {
    return collapse(change, copied, side, options);
  });
  if (collapses.empty()) return -1;
  const DomainSide best = collapses.front().side;
  const DomainVertex n = surviving_vertex(map, best);
  return collapse(map, measures, best, options, scratch) ? n : -1;
}

/// A vertex more, in the middle of a side. \return false where none can be made
bool give_vertex(WorkingMap& map, DomainSide side, Scratch& scratch) {
  const auto made = split(map, side, kRelaxSplit, scratch);
  if (made) improve_domain_around(map, made->vertex, scratch);
  return made.has_value();
}

/// A vertex less, where that raises the energy least. \return false where none can go
bool take_vertex(WorkingMap& map, SurfaceMeasures& measures, Scratch& scratch) {
  const DomainVertex left = collapse_best_of_cheapest(map, measures, scratch);
  if (left < 0) return false;
  free_regular_vertices(map);
  improve_domain_around(map, left, scratch);
  free_regular_vertices(map);
  return true;
}

/// \return the energy
double settle_between(WorkingMap& map, int epochs) { return optimize_globally(map, effort_after_moves(epochs)).back(); }

/// Less is gained by the relaxation alone when a vertex comes back to where it was taken from.
bool has_gained(double before, double after) {
  constexpr double kLeastGain = 2e-3;  // share of what is above an isometry
  return after < before - kLeastGain * (before - 1);
}

/// Gives a vertex to a side, takes another one away, and settles. \return whether the energy is lower then
bool move_vertex_to(TrialCopy& copy, DomainSide side) {
  const double before = total_energy(copy.map);
  if (!give_vertex(copy.map, side, copy.scratch) || !take_vertex(copy.map, copy.measures, copy.scratch)) return false;
  return has_gained(before, settle_between(copy.map, 2));
}

/// Gives several vertices first, each where it is best, and takes as many away then. \return whether the energy is
/// lower then
bool move_vertices(TrialCopy& copy, int count) {
  const double before = total_energy(copy.map);
  for (int i = 0; i < count; ++i) {
    const std::vector<RatedSide> splits = best_splits(copy.map, copy.measures);
    if (splits.empty() || !give_vertex(copy.map, splits.front().side, copy.scratch)) return false;
  }
  free_regular_vertices(copy.map);
  settle_between(copy.map, 2);
  for (int i = 0; i < count; ++i) {
    if (!take_vertex(copy.map, copy.measures, copy.scratch)) return false;
    settle_between(copy.map, 1);
  }
  return has_gained(before, settle_between(copy.map, 2));
}

/// Of several things to try, each on a copy, the first that gains becomes the map. Two are tried at a time where there
/// are threads for them. \param attempt  (copy, i) -> whether it has gained \return false, with nothing changed, where
/// none does
template <typename Attempt>
bool take_first_gain(WorkingMap& map, SurfaceMeasures& measures, std::size_t count, Attempt&& attempt) {
  const std::size_t at_once = most_threads() > 1 ? 2 : 1;
  struct Trial {
    TrialCopy copy;
    bool gained = false;
  };
  for (std::size_t first = 0; first < count; first += at_once) {
    std::vector<Trial> trials(std::min(at_once, count - first));
    for_each_index(trials.size(), true, [&](std::size_t i) {
      trials[i].copy = {map, measures, {}};
      trials[i].gained = attempt(trials[i].copy, first + i);
    });
    for (Trial& trial : trials) {
      if (!trial.gained) continue;
      map = std::move(trial.copy.map);
      measures = std::move(trial.copy.measures);
      return true;
    }
  }
  return false;
}

/// One vertex, to one of the best places for it.
bool move_one(WorkingMap& map, SurfaceMeasures& measures) {
  constexpr std::size_t kMostTried = 4;  // six: 0.4 % less distortion, 6 % more time
  const std::vector<RatedSide> splits = best_splits(map, measures);
  return take_first_gain(map, measures, std::min(kMostTried, splits.size()),
                         [&](TrialCopy& copy, std::size_t i) { return move_vertex_to(copy, splits[i].side); });
}

/// Several, where none gains on its own.
bool move_several(WorkingMap& map, SurfaceMeasures& measures) {
  constexpr std::array<int, 2> kCounts{3, 2};  // up to five took longer than they gained
  return take_first_gain(map, measures, kCounts.size(),
                         [&](TrialCopy& copy, std::size_t i) { return move_vertices(copy, kCounts[i]); });
}

}  // namespace

int relocate_vertices(WorkingMap& map, SurfaceMeasures& measures, int most_moves) {
  constexpr int kMostOfSeveral = 4;  // each takes as long as several of one vertex
  int moves = 0;
  while (moves < most_moves && move_one(map, measures)) ++moves;
  for (int i = 0; i < kMostOfSeveral && move_several(map, measures); ++i) ++moves;
  return moves;
}

}  // namespace lozenge
