// The loop is short: collapse the cheapest edge, as long as the domain is larger than asked for; now and then relax the
// whole map, heal edges by flips, and take vertices out of the mesh, which is finer than the domain needs. In the
// interval each size's map is judged and the best one kept. What is dear is done only where it shows: far above the
// interval the cost (2) decides which edge goes, near it what a collapse really raises the energy by, and in a domain
// of a few dozen triangles the whole map, relaxed.
#include "stages/parameterize/search/decimation.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>

#include "stages/parameterize/levels/coarsen.h"
#include "stages/parameterize/map/map_energy.h"
#include "stages/parameterize/operations/can_collapse.h"
#include "stages/parameterize/operations/collapse.h"
#include "stages/parameterize/operations/heal_edges.h"
#include "stages/parameterize/operations/warm_up.h"
#include "stages/parameterize/relax/global_optimization.h"
#include "stages/parameterize/relax/trials.h"
#include "stages/parameterize/search/collapse_queue.h"
#include "stages/parameterize/search/domain_search.h"
#include "stages/parameterize/search/efforts.h"
#include "stages/parameterize/search/known_rises.h"
#include "stages/parameterize/search/measure_map.h"
#include "stages/parameterize/search/relocation.h"

namespace lozenge {

namespace {

/// Of single vertices at the end: a bound on the time.
constexpr int kMostRelocations = 10;
/// Epochs each time the domain has shrunk by some factor, or was refused a collapse.
constexpr int kEpochsOnTheWay = 2;
/// Of domains this large every look at the whole map is dear, and one vertex more or less shows little.
constexpr int kVeryLarge = 1000;

bool is_warm(const WorkingMap& map) {
  for (DomainTriangleId t = 0; t < map.domain.size(); ++t) {
    if (map.domain.corner(t, 0) < 0) continue;
    int count = 0;
    for (VertexId v = map.first_in[t]; v >= 0 && count <= kWarmVertices; v = map.next_in[v]) ++count;
    if (count <= kWarmVertices) return false;
  }
  return true;
}

/// A map to go back to, and how many vertices had been taken out of its mesh.
struct BestMap {
  WorkingMap map;
  std::size_t removals;
};

/// A map that was tried.
struct TrialMap {
  WorkingMap map;
  double energy = 0;
};

/// Decimation with everything that goes on beside it.
class Decimation {
 public:
  Decimation(WorkingMap& map, const DecimationOptions& options, std::vector<Removal>& removals,
             const Progress& progress)
      : map_(map), options_(options), removals_(removals), progress_(progress), measures_(trivial_measures(map)) {
    for (TriangleId t = 0; t < map.mesh.triangle_count(); ++t) triangles_ += !map.mesh.removed(t);
  }

  std::vector<TraceRow> run() {
    const std::int32_t start = map_.domain_faces;
    double next_optimization = start / options_.optimize_every;
    queue_.rebuild(map_, measures_);
    record();
    while (map_.domain_faces > options_.min_faces && (collapse_cheapest() || collapse_after_another_look())) {
      const int faces = map_.domain_faces;
      coarsen_along();
      if (is_healing_size(faces)) {
        optimize(kEpochsOnTheWay);
        heal_overlong_edges(map_, measures_, scratch_);
        queue_.rebuild(map_, measures_);
      } else if (faces < next_optimization && faces > options_.max_faces) {
        optimize(kEpochsOnTheWay);
        queue_.rebuild(map_, measures_);
        next_optimization = faces / options_.optimize_every;
      }
      record();
      report(progress_, "decimating the domain",
             std::log(static_cast<double>(start) / faces) / std::log(static_cast<double>(start) / options_.min_faces));
    }
    // Where no collapse leads into the interval, the domain that is left is the one.
    if (!best_) improve();
    if (best_) {
      map_ = best_->map;
      removals_.resize(best_->removals);
    }
    if (map_.domain_faces > map_.small_domain && map_.domain_faces <= kVeryLarge) {
      improve_domain(map_, scratch_);
      measures_.vertex_area = voronoi_areas(map_);
      relocate_vertices(map_, measures_, kMostRelocations);
    }
    return trace_;
  }

 private:
  /// Of a small domain, where each collapse matters: the cheapest edges are all collapsed, each on its own, and the
  /// relaxed maps compared; the best few are improved by flips, and compared again.
  bool collapse_best() {
    const std::size_t most_tried = map_.domain_faces <= 30 ? 45 : 16;  // 45: the edges of 30 triangles
    constexpr std::size_t kImproved = 3;  // a bound on the time: each takes longer than the trials before
    std::vector<DomainSide> tried;
    while (tried.size() < most_tried) {
      const auto side = queue_.pop(map_);
      if (!side) break;
      if (can_collapse(map_, *side)) tried.push_back(*side);
    }
    std::vector<TrialMap> collapsed;
    for (const DomainSide side : tried) {
      TrialMap trial{map_};
      SurfaceMeasures measures = measures_;
      if (!collapse(trial.map, measures, side, {kRelaxAround, measures_.warming_up}, scratch_)) continue;
      if (!measures_.warming_up) free_regular_vertices(trial.map);
      trial.energy = optimize_globally(trial.map, effort_to_judge(options_.at_once)).back();
      keep_best(collapsed, std::move(trial), kImproved);
    }
    if (collapsed.empty()) return false;
    std::vector<TrialMap> improved;
    for (TrialMap& trial : collapsed) {
      improve_domain(trial.map, scratch_);
      trial.energy = total_energy(trial.map);
      keep_best(improved, std::move(trial), 1);
    }
    map_ = std::move(improved.front().map);
    queue_.rebuild(map_, measures_);
    return true;
  }

  /// Adds what was found in order of energy, and drops what comes after the first `most`.
  static void keep_best(std::vector<TrialMap>& results, TrialMap found, std::size_t most) {
    auto place = results.begin();
    while (place != results.end() && place->energy <= found.energy) ++place;
    if (place - results.begin() >= static_cast<std::ptrdiff_t>(most)) return;
    results.insert(place, std::move(found));
    if (results.size() > most) results.pop_back();
  }

  /// \return false where no collapse is left
  bool collapse_cheapest() {
    if (!measures_.warming_up && map_.domain_faces <= map_.small_domain) return collapse_best();
    if (is_near_interval()) return collapse_least_rise();
    while (const auto side = queue_.pop(map_)) {
      if (!can_collapse(map_, *side)) continue;
      const DomainVertex n = surviving_vertex(map_, *side);
      const CollapseOptions options{kRelaxAround, measures_.warming_up};
      if (!collapse(map_, measures_, *side, options, scratch_)) continue;
      queue_.update_star(map_, measures_, n);
      last_ = n;
      return true;
    }
    return false;
  }

  /// Of a domain near the interval: the cheapest few by (2) are tried, and the one that raises the energy least is
  /// carried out.
  bool collapse_least_rise() {
    const CollapseOptions options{kRelaxAround, measures_.warming_up};
    const auto try_collapse = [&](LocalChange& change, SurfaceMeasures& copied, DomainSide side) {
      return collapse(change, copied, side, options);
    };
    const auto most = static_cast<std::size_t>(options_.tried_collapses);
    std::vector<DomainSide> tried;
    bool fresh = false;
    while (tried.size() < most) {
      const std::vector<DomainSide> batch = pop_possible(most - tried.size());
      if (batch.empty()) break;
      rises_.find_out(map_, measures_, batch, try_collapse, copies_, fresh);
      std::copy_if(batch.begin(), batch.end(), std::back_inserter(tried),
                   [&](DomainSide side) { return rises_.of(map_.domain, side).has_value(); });
    }
    if (tried.empty()) return false;
    const DomainSide best = *std::min_element(tried.begin(), tried.end(), [&](DomainSide a, DomainSide b) {
      return *rises_.of(map_.domain, a) < *rises_.of(map_.domain, b);
    });
    const DomainVertex n = surviving_vertex(map_, best);
    if (!collapse(map_, measures_, best, options, scratch_)) return false;
    for (const DomainSide side : tried) {
      if (map_.domain.corner(side.triangle, 0) >= 0) queue_.push(map_, measures_, side);
    }
    queue_.update_star(map_, measures_, n);
    rises_.forget_near(map_, n);
    last_ = n;
    return true;
  }

  /// The next cheapest sides that may be collapsed, off the queue; at most so many.
  std::vector<DomainSide> pop_possible(std::size_t most) {
    std::vector<DomainSide> sides;
    while (sides.size() < most) {
      const auto side = queue_.pop(map_);
      if (!side) break;
      if (can_collapse(map_, *side)) sides.push_back(*side);
    }
    return sides;
  }

  /// What was refused once may go well when the map around has settled.
  bool collapse_after_another_look() {
    optimize(kEpochsOnTheWay);
    rises_.forget_all();
    queue_.rebuild(map_, measures_);
    return collapse_cheapest();
  }

  void coarsen_along() {
    constexpr double kSlack = 1.25;  // so that it pays: what follows is an optimization of the whole map
    const double wanted = options_.mesh_size.triangles_for(map_.domain_faces);
    if (options_.mesh_size.triangles_per_face <= 0 || triangles_ < kSlack * wanted) return;
    const std::vector<Removal> removed = coarsen(map_, static_cast<std::int32_t>(wanted));
    removals_.insert(removals_.end(), removed.begin(), removed.end());
    for (const Removal& removal : removed) triangles_ -= removal.triangles();
    measures_.vertex_area = voronoi_areas(map_);
    rises_.forget_all();
    optimize(1);
    queue_.rebuild(map_, measures_);
  }

  /// \return whether the domain has floor(1.5^h N) triangles, h = 0, 1, 2, where N is the least size that is asked for
  bool is_healing_size(int faces) const {
    for (const double factor : {1.0, 1.5, 2.25}) {
      const int size = static_cast<int>(std::floor(factor * options_.min_faces));
      // Faces go down by two: an odd size is passed at the even one above.
      if (faces == size || faces == size + 1) return true;
    }
    return false;
  }

  bool is_near_interval() const {
    constexpr double kJustAbove = 1.1;  // of very large domains: each trial costs as much as of small ones
    const double below = options_.max_faces > kVeryLarge ? kJustAbove : options_.judged_below;
    return map_.domain_faces <= below * options_.max_faces;
  }

  /// Regular vertices are held where they are in space while that is what collapses are measured by; near the interval,
  /// where energies are compared, that would be in the way.
  void free_regular() {
    if (!measures_.warming_up || is_near_interval()) free_regular_vertices(map_);
  }

  void optimize(int epochs) {
    if (measures_.warming_up) measures_.warming_up = !is_warm(map_);
    free_regular();
    // Cones of a domain far from the interval are soon collapsed.
    const bool cones_move = map_.domain_faces <= options_.cones_below * options_.max_faces;
    optimize_globally(map_,
                      effort_on_the_way(epochs, options_.at_once, cones_move ? Cones::kInTheirStars : Cones::kStay));
  }

  /// Better flips: everywhere, in small domains and when the interval is entered; else around the last collapse.
  void improve() {
    if (last_ < 0 || map_.domain_faces <= map_.small_domain || trace_.empty()) {
      optimize(1);
      improve_domain(map_, scratch_);
      return;
    }
    free_regular();
    improve_domain_around(map_, last_, scratch_);
    optimize_globally(map_, effort_on_the_way(1, options_.at_once, Cones::kStay));
  }

  /// Keeps the map that is judged best so far, inside the interval.
  void record() {
    const int faces = map_.domain_faces;
    if (faces > options_.max_faces || faces < options_.min_faces) return;
    // The distortion changes slowly: of a large domain, every hundredth of its size is enough, of a very large one
    // every fortieth.
    const double finer = faces > kVeryLarge ? 0.975 : 0.99;
    const bool is_last = faces - 2 < options_.min_faces;
    if (!trace_.empty() && !is_last && faces > finer * trace_.back().domain_faces) return;
    improve();
    const TraceRow row = measure_map(map_);
    trace_.push_back(row);
    const double judged = options_.judge ? options_.judge(row) : row.weighed;
    if (best_ && judged >= least_) return;
    least_ = judged;
    best_ = BestMap{map_, removals_.size()};
  }

  WorkingMap& map_;
  DecimationOptions options_;
  std::vector<Removal>& removals_;
  const Progress& progress_;
  std::int32_t triangles_ = 0;  ///< left in the mesh
  SurfaceMeasures measures_;
  CollapseQueue queue_;
  std::vector<TraceRow> trace_;
  std::optional<BestMap> best_;
  double least_ = 0;  ///< what `best_` was judged
  KnownRises rises_;  ///< of collapses
  TrialCopies copies_;
  Scratch scratch_;
  DomainVertex last_ = -1;  ///< what the last collapse made
};

}  // namespace

std::vector<TraceRow> decimate(WorkingMap& map, const DecimationOptions& options, std::vector<Removal>& removals,
                               const Progress& progress) {
  return Decimation(map, options, removals, progress).run();
}

}  // namespace lozenge
