// The cone's vertex and one beside it swap roles: that one is pinned to the domain vertex, and the one that the cone
// leaves is put into the rest of the triangles that were around it, which become its own. Every neighbour is tried,
// what is within a few edges relaxed, and the best of them kept. Cones so far apart that what moves with them doesn't
// touch crawl side by side.
#include "stages/parameterize/relax/crawl.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "formats/base/parallel.h"
#include "stages/parameterize/map/fan.h"
#include "stages/parameterize/map/homes.h"
#include "stages/parameterize/map/marks.h"
#include "stages/parameterize/map/pins.h"
#include "stages/parameterize/map/star.h"
#include "stages/parameterize/relax/local_optimization.h"

namespace lozenge {

namespace {

/// Around a cone, what moves along with it.
constexpr int kRings = 3;
/// Of each step, before it is judged: four sweeps spread what it changes over as many edges.
constexpr RelaxOptions kSettle{4, 1e-2};

/// A way for a cone: from the vertex that it is pinned to over an edge to one of its neighbours.
class Step {
 public:
  /// \param spoke  leaves `from`, in a triangle of the edge \param to  its end, or, on the boundary, the last corner of
  /// its triangle
  Step(WorkingMap& map, Halfedge spoke, VertexId to) : map_(map), from_(map.mesh.start(spoke)), to_(to) {
    const HalfedgeMesh& mesh = map.mesh;
    if (mesh.end(spoke) == to) {
      left_ = spoke;
      right_ = mesh.twins[spoke];
    } else {
      right_ = previous_in_triangle(spoke);
      left_ = mesh.twins[right_];
    }
  }

  /// \return false, with nothing changed, where there is no place for the vertex that the cone leaves
  bool carry_out() {
    const auto rest = rest_of();
    if (!rest) return false;
    const bool on_boundary = left_ < 0 || right_ < 0;
    constexpr double kHalfway = 0.5;
    const auto place = on_boundary
                           ? find_place_on_boundary(map_, *rest, left_ < 0 ? Along::kAhead : Along::kBack, kHalfway)
                           : find_place(map_, *rest, mean_of(rest->outline));
    if (!place) return false;

    const DomainVertex n = map_.pin[from_];
    const int corner = map_.corner_of[n].corner;
    const UnitPoint cone = corner_step(corner_of_pinned(map_, from_));
    const auto pinned_like = [&](Halfedge spoke) { return chart_of_pinned(corner, map_.chart[spoke](cone)); };
    std::vector<std::pair<Halfedge, UnitMotion>> charts;
    for_each_outgoing(map_.mesh, to_, [&](Halfedge h) {
      charts.emplace_back(h, chart_of_pinned(corner, map_.chart[h](seen_from_the_end(cone))));
    });
    const auto set = [&](Halfedge h, const UnitMotion& a, const UnitMotion& b, const UnitMotion& c) {
      charts.emplace_back(h, a);
      charts.emplace_back(next_in_triangle(h), b);
      charts.emplace_back(previous_in_triangle(h), c);
    };
    const auto chart = [&](const Fan::Slice& slice) { return composed(inverse(slice.into_fan), place->into_fan); };
    // The triangles at the edge take the frames of the fan's ends.
    const Halfedge first = rest->slices.front().spoke;
    const Halfedge last = rest->slices.back().spoke;
    if (left_ >= 0) {
      set(left_, chart(rest->slices.front()), pinned_like(first), map_.chart[next_in_triangle(first)]);
    }
    if (right_ >= 0) {
      set(right_, pinned_like(last), chart(rest->slices.back()), map_.chart[previous_in_triangle(last)]);
    }
    for (const Fan::Slice& slice : rest->slices) charts.emplace_back(slice.spoke, chart(slice));
    for (const auto& [h, motion] : charts) map_.chart[h] = motion;
    unpin(map_, from_);
    set_home(map_, from_, place->home, place->at);
    pin_to(map_, to_, n);
    return true;
  }

 private:
  /// The triangles around the cone but those at the edge.
  std::optional<Fan> rest_of() const {
    const HalfedgeMesh& mesh = map_.mesh;
    const Halfedge first = left_ >= 0 ? mesh.next_around(left_) : mesh.outgoing[from_];
    const Halfedge behind = right_ >= 0 ? next_in_triangle(right_) : -1;
    const Halfedge last = right_ >= 0 ? mesh.previous_around(behind) : last_of_fan(mesh, left_);
    if (first < 0 || last < 0 || first == behind || last == left_) return std::nullopt;
    return lay_out_fan(map_, first, last);
  }

  /// The cone as the free vertex sees it over the edge.
  UnitPoint seen_from_the_end(UnitPoint cone) const {
    if (left_ >= 0) return inverse(map_.chart[next_in_triangle(left_)])(map_.chart[left_](cone));
    return inverse(map_.chart[right_])(map_.chart[next_in_triangle(right_)](cone));
  }

  WorkingMap& map_;
  Halfedge left_ = -1;   ///< from the cone to the free vertex
  Halfedge right_ = -1;  ///< and back
  VertexId from_, to_;
};

/// Vertices within so many edges, nearest first.
std::vector<VertexId> vertices_near(const WorkingMap& map, VertexId v, int rings, Marks& marks) {
  marks.clear(map.home.size());
  marks.add(v);
  std::vector<VertexId> near{v};
  std::size_t begin = 0;
  for (int ring = 0; ring < rings; ++ring) {
    const std::size_t end = near.size();
    for (; begin < end; ++begin) {
      for_each_neighbour(map.mesh, near[begin], [&](VertexId w) {
        if (marks.add(w)) near.push_back(w);
      });
    }
  }
  return near;
}

/// Moves cones from `waiting` into the result, in their order, as long as no vertex is within `rings` edges of two of
/// them: what is done to them within less can be done side by side.
std::vector<DomainVertex> take_far_apart(const WorkingMap& map, std::vector<DomainVertex>& waiting, int rings) {
  Marks taken, met;
  taken.clear(map.home.size());
  std::vector<DomainVertex> apart, others;
  for (const DomainVertex n : waiting) {
    const std::vector<VertexId> near = vertices_near(map, map.anchor[n], rings, met);
    const bool is_free = std::none_of(near.begin(), near.end(), [&](VertexId v) { return taken.has(v); });
    (is_free ? apart : others).push_back(n);
    if (!is_free) continue;
    for (const VertexId v : near) taken.add(v);
  }
  waiting = std::move(others);
  return apart;
}

struct Way {
  Halfedge spoke;
  VertexId to;
};

/// To every free neighbour; on the boundary to those beside it there.
std::vector<Way> ways_of(const WorkingMap& map, VertexId from) {
  const HalfedgeMesh& mesh = map.mesh;
  const bool on_boundary = mesh.on_boundary(from);
  std::vector<Way> ways;
  for_each_outgoing(mesh, from, [&](Halfedge h) {
    if (map.pin[mesh.end(h)] < 0 && mesh.on_boundary(mesh.end(h)) == on_boundary && (!on_boundary || mesh.twins[h] < 0))
      ways.push_back({h, mesh.end(h)});
  });
  if (on_boundary) {
    const Halfedge last = last_of_fan(mesh, mesh.outgoing[from]);
    if (map.pin[mesh.opposite(last)] < 0) ways.push_back({last, mesh.opposite(last)});
  }
  return ways;
}

}  // namespace

std::optional<double> crawl(LocalChange& change, DomainVertex n) {
  WorkingMap& map = change.map();
  if (map.kept[n] || map.anchor[n] < 0) return std::nullopt;
  const VertexId from = map.anchor[n];
  const std::vector<VertexId> around = vertices_near(map, from, kRings, change.scratch().vertices);
  change.keep_domain_vertex(n);
  change.keep_around(around);
  change.measure_before();

  const auto go = [&](const Way& way) {
    if (!Step(map, way.spoke, way.to).carry_out() || !heal_folds(map, around)) return false;
    relax(map, around, kSettle);
    return true;
  };
  double best = change.before();
  std::optional<Way> best_way;
  for (const Way& way : ways_of(map, from)) {
    if (go(way)) {
      const double after = change.energy();
      if (after < best && change.is_sound()) {
        best = after;
        best_way = way;
      }
    }
    change.restore();
  }
  if (!best_way) return std::nullopt;
  go(*best_way);
  return best - change.before();
}

std::optional<double> crawl(WorkingMap& map, DomainVertex n, Scratch& scratch) {
  return carry_out(map, scratch, [&](LocalChange& change) { return crawl(change, n); });
}

double crawl_all(WorkingMap& map, int most_steps) {
  std::vector<DomainVertex> waiting;
  for (DomainVertex n = 0; n < static_cast<DomainVertex>(map.corner_of.size()); ++n) {
    if (map.corner_of[n].triangle >= 0 && map.anchor[n] >= 0 && !valence(map, n).is_regular()) waiting.push_back(n);
  }
  const bool was_listed = std::exchange(map.listed, false);
  PerThread<Scratch> scratch;
  double sum = 0;
  while (!waiting.empty()) {
    const std::vector<DomainVertex> cones = take_far_apart(map, waiting, kRings + 1 + most_steps);
    std::vector<double> fallen(cones.size(), 0);
    for_each_index(cones.size(), true, [&](std::size_t i) {
      for (int step = 0; step < most_steps; ++step) {
        const auto rise = crawl(map, cones[i], scratch.local());
        if (!rise) break;
        fallen[i] -= *rise;
      }
    });
    sum = std::accumulate(fallen.begin(), fallen.end(), sum);
  }
  if (was_listed) list_homes(map);
  return sum;
}

}  // namespace lozenge
