#include "stages/parameterize/search/decimation.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>

#include "formats/domain/distortion.h"
#include "stages/parameterize/levels/coarsen.h"
#include "stages/parameterize/map/snapshot.h"
#include "stages/parameterize/operations/collapse.h"
#include "stages/parameterize/operations/flip.h"
#include "stages/parameterize/operations/warm_up.h"
#include "stages/parameterize/relax/global_optimization.h"
#include "stages/parameterize/relax/star_embedding.h"
#include "stages/parameterize/relax/trials.h"
#include "stages/parameterize/search/collapse_queue.h"
#include "stages/parameterize/search/domain_search.h"
#include "stages/parameterize/search/known_rises.h"
#include "stages/parameterize/search/relocation.h"

namespace lozenge {

namespace {

constexpr int kMostRelocations = 10;
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
struct Kept {
  Snapshot map;
  std::size_t removals;
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
        optimize(2);
        heal_overlong_edges(map_, measures_);
        queue_.rebuild(map_, measures_);
      } else if (faces < next_optimization && faces > options_.max_faces) {
        optimize(2);
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
      go_back(map_, best_->map);
      removals_.resize(best_->removals);
    }
    if (map_.domain_faces > map_.small_domain && map_.domain_faces <= kVeryLarge) {
      improve_domain(map_);
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
    constexpr std::size_t kImproved = 3;
    const Snapshot snapshot = take_snapshot(map_);
    const SurfaceMeasures measures = measures_;
    std::vector<DomainSide> tried;
    while (tried.size() < most_tried) {
      const auto side = queue_.pop(map_);
      if (!side) break;
      if (can_collapse(map_, *side)) tried.push_back(*side);
    }
    std::vector<std::pair<double, Snapshot>> results;
    for (const DomainSide side : tried) {
      if (collapse(map_, measures_, side, {{5, 1e-2}, measures_.warming_up})) {
        if (!measures_.warming_up) free_regular_vertices(map_);
        const double energy = optimize_globally(map_, {3, 2e-2, 6, options_.at_once, Cones::kInTheirStars}).back();
        keep_best(results, energy, kImproved);
      }
      go_back(map_, snapshot);
      measures_ = measures;
    }
    if (results.empty()) return false;
    std::vector<std::pair<double, Snapshot>> improved;
    for (const auto& result : results) {
      go_back(map_, result.second);
      improve_domain(map_);
      keep_best(improved, total_energy(map_), 1);
    }
    go_back(map_, improved.front().second);
    queue_.rebuild(map_, measures_);
    return true;
  }

  /// Adds the map as it stands, in order of energy, and drops what comes after the first `most`.
  void keep_best(std::vector<std::pair<double, Snapshot>>& results, double energy, std::size_t most) const {
    auto place = results.begin();
    while (place != results.end() && place->first <= energy) ++place;
    if (place - results.begin() >= static_cast<std::ptrdiff_t>(most)) return;
    results.insert(place, {energy, take_snapshot(map_)});
    if (results.size() > most) results.pop_back();
  }

  /// \return false where no collapse is left
  bool collapse_cheapest() {
    if (!measures_.warming_up && map_.domain_faces <= map_.small_domain) return collapse_best();
    if (is_near_interval()) return collapse_least_rise();
    while (const auto side = queue_.pop(map_)) {
      if (!can_collapse(map_, *side)) continue;
      const DomainVertex n = surviving_vertex(map_, *side);
      const CollapseOptions options{{5, 1e-2}, measures_.warming_up};
      if (!collapse(map_, measures_, *side, options)) continue;
      queue_.update_star(map_, measures_, n);
      last_ = n;
      return true;
    }
    return false;
  }

  /// Of a domain near the interval: the cheapest few by (2) are tried, and the one that raises the energy least is
  /// carried out.
  bool collapse_least_rise() {
    const CollapseOptions options{{5, 1e-2}, measures_.warming_up};
    const auto try_collapse = [&](TrialCopies::Copy& copy, DomainSide side, Checkpoint& undo, double& rise) {
      return collapse(copy.map, copy.measures, side, options, undo, rise);
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
    if (!collapse(map_, measures_, best, options)) return false;
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
    optimize(2);
    rises_.forget_all();
    queue_.rebuild(map_, measures_);
    return collapse_cheapest();
  }

  void coarsen_along() {
    constexpr double kSlack = 1.25;
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
    constexpr double kJustAbove = 1.1;
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
    optimize_globally(map_, {epochs, 1e-2, 4, options_.at_once, cones_move ? Cones::kInTheirStars : Cones::kStay});
  }

  /// Better flips: everywhere, in small domains and when the interval is entered; else around the last collapse.
  void improve() {
    if (last_ < 0 || map_.domain_faces <= map_.small_domain || trace_.empty()) {
      optimize(1);
      improve_domain(map_);
      return;
    }
    free_regular();
    improve_domain_around(map_, last_);
    optimize_globally(map_, {1, 1e-2, 4, options_.at_once, Cones::kStay});
  }

  /// Keeps the map that is judged best so far, inside the interval.
  void record() {
    const int faces = map_.domain_faces;
    if (faces > options_.max_faces || faces < options_.min_faces) return;
    // (6) changes slowly: of a large domain, every hundredth of its size is enough, of a very large one every fortieth.
    const double finer = faces > kVeryLarge ? 0.975 : 0.99;
    const bool is_last = faces - 2 < options_.min_faces;
    if (!trace_.empty() && !is_last && faces > finer * trace_.back().domain_faces) return;
    improve();
    const TraceRow row = measure_map(map_);
    trace_.push_back(row);
    const double judged = options_.judge ? options_.judge(row) : row.weighed;
    if (best_ && judged >= least_) return;
    least_ = judged;
    best_ = Kept{take_snapshot(map_), removals_.size()};
  }

  WorkingMap& map_;
  DecimationOptions options_;
  std::vector<Removal>& removals_;
  const Progress& progress_;
  std::int32_t triangles_ = 0;  ///< left in the mesh
  SurfaceMeasures measures_;
  CollapseQueue queue_;
  std::vector<TraceRow> trace_;
  std::optional<Kept> best_;
  double least_ = 0;  ///< what `best_` was judged
  KnownRises rises_;  ///< of collapses
  TrialCopies copies_;
  DomainVertex last_ = -1;  ///< what the last collapse made
};

}  // namespace

std::vector<TraceRow> decimate(WorkingMap& map, const DecimationOptions& options, std::vector<Removal>& removals,
                               const Progress& progress) {
  return Decimation(map, options, removals, progress).run();
}

int heal_overlong_edges(WorkingMap& map, const SurfaceMeasures& measures) {
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
    done += flip(map, side, {5, 1e-2});
  }
  return done;
}

TraceRow measure_map(const WorkingMap& map) {
  TraceRow row;
  row.domain_faces = map.domain_faces;
  const double scale = map.scale();
  for (TriangleId t = 0; t < map.mesh.triangle_count(); ++t) {
    if (map.mesh.removed(t)) continue;
    const FlatImage p = flat_image(map, t);
    const RestShape& rest = map.rest[t];
    const double d = doubled_area(p) * rest.inverse_area * scale;
    double length = 0;
    for (int i = 0; i < 3; ++i) length += rest.weight[i] * (p[(i + 1) % 3] - p[(i + 2) % 3]).length2();
    if (!(d > 0)) continue;
    row.area += rest.share * ((d + 1 / d) / 2 - 1);
    row.angle += rest.share * (length * scale / (2 * d) - 1);
  }
  row.aggregate = aggregate_of(1 + row.area, 1 + row.angle);
  row.weighed = weighed_by_size(row.aggregate, row.domain_faces);
  return row;
}

}  // namespace lozenge
