#include "stages/parameterize/crawl.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "stages/parameterize/checkpoint.h"
#include "stages/parameterize/fan.h"
#include "stages/parameterize/local_optimization.h"
#include "stages/parameterize/star_embedding.h"

namespace lozenge {

namespace {

class Step {
 public:
  /// From the start of h, where the cone lies, to its end, which is free.
  Step(WorkingMap& map, Halfedge h) : map_(map), h_(h), from_(map.mesh.start(h)), to_(map.mesh.end(h)) {}

  /// \return false, with nothing changed, where there is no place for the vertex that the cone leaves
  bool carry_out() {
    HalfedgeMesh& mesh = map_.mesh;
    const Halfedge first = mesh.next_around(h_);
    const Halfedge behind = next_in_triangle(mesh.twins[h_]);  // leaves `from`, its triangle ends at h
    const Halfedge last = next_in_triangle(mesh.twins[behind]);
    if (first == behind || mesh.next_around(first) == h_) return false;
    const Fan rest = lay_out_fan(map_, first, last);
    const auto place = find_place(map_, rest, mean_of(rest.outline));
    if (!place) return false;

    const DomainVertex n = map_.pin[from_];
    const int corner = map_.corner_of[n].corner;
    const UnitPoint cone = corner_step(corner_of_pinned(map_, from_));
    const auto pinned_like = [&](Halfedge spoke) { return chart_of_pinned(corner, map_.chart[spoke](cone)); };
    // The cone as the free vertex sees it over the edge.
    const UnitPoint seen = inverse(map_.chart[next_in_triangle(h_)])(map_.chart[h_](cone));
    std::vector<std::pair<Halfedge, UnitMotion>> charts;
    for_each_outgoing(mesh, to_,
                      [&](Halfedge h) { charts.emplace_back(h, chart_of_pinned(corner, map_.chart[h](seen))); });
    const auto set = [&](Halfedge h, const UnitMotion& a, const UnitMotion& b, const UnitMotion& c) {
      charts.emplace_back(h, a);
      charts.emplace_back(next_in_triangle(h), b);
      charts.emplace_back(previous_in_triangle(h), c);
    };
    // The two triangles at the edge take the frames of the fan's ends.
    const UnitMotion at_end = composed(inverse(rest.slices.back().into_fan), place->into_fan);
    set(h_, place->into_fan, pinned_like(first), map_.chart[next_in_triangle(first)]);
    set(behind, at_end, map_.chart[previous_in_triangle(last)], pinned_like(last));
    for (const Fan::Slice& slice : rest.slices) {
      charts.emplace_back(slice.spoke, composed(inverse(slice.into_fan), place->into_fan));
    }
    for (const auto& [h, chart] : charts) map_.chart[h] = chart;
    unpin(map_, from_);
    set_home(map_, from_, place->home, place->at);
    pin_to(map_, to_, n);
    return true;
  }

 private:
  WorkingMap& map_;
  Halfedge h_;
  VertexId from_, to_;
};

/// Vertices within so many edges, nearest first.
std::vector<VertexId> vertices_near(const WorkingMap& map, VertexId v, int rings) {
  thread_local Marks marks;
  marks.clear(map.home.size());
  marks.add(v);
  std::vector<VertexId> near{v};
  std::size_t begin = 0;
  for (int ring = 0; ring < rings; ++ring) {
    const std::size_t end = near.size();
    for (; begin < end; ++begin) {
      for_each_outgoing(map.mesh, near[begin], [&](Halfedge h) {
        if (marks.add(map.mesh.end(h))) near.push_back(map.mesh.end(h));
      });
    }
  }
  return near;
}

}  // namespace

double crawl(WorkingMap& map, DomainVertex n) {
  if (map.kept[n]) return 0;
  constexpr int kRings = 3;
  const RelaxOptions settle{4, 1e-2};
  const VertexId from = map.anchor[n];
  const std::vector<VertexId> around = vertices_near(map, from, kRings);
  thread_local Marks marks;
  std::vector<TriangleId> triangles;
  triangles_around(map, around, marks, triangles);
  const double before = energy_of(map, triangles);
  Checkpoint start(map);
  start.keep_domain_vertex(n);
  for (const VertexId v : around) start.keep_vertex(v);
  for (const TriangleId t : triangles) start.keep_charts(t);

  std::vector<Halfedge> ways;
  for_each_outgoing(map.mesh, from, [&](Halfedge h) {
    if (map.pin[map.mesh.end(h)] < 0) ways.push_back(h);
  });
  const auto go = [&](Halfedge h) {
    if (!Step(map, h).carry_out() || !heal_folds(map, around)) return false;
    relax(map, around, settle);
    return true;
  };
  double best = before;
  Halfedge best_way = -1;
  for (const Halfedge h : ways) {
    if (go(h)) {
      const double after = energy_of(map, triangles);
      const bool sound = std::all_of(triangles.begin(), triangles.end(),
                                     [&](TriangleId t) { return is_consistent(map, t) && agrees_with_domain(map, t); });
      if (sound && after < best) {
        best = after;
        best_way = h;
      }
    }
    start.restore();
  }
  if (best_way < 0) return 0;
  go(best_way);
  return before - best;
}

void crawl_all(WorkingMap& map, int most_steps) {
  for (DomainVertex n = 0; n < static_cast<DomainVertex>(map.corner_of.size()); ++n) {
    if (map.corner_of[n].triangle < 0 || map.anchor[n] < 0 || valence(map, n) == 6) continue;
    for (int step = 0; step < most_steps && crawl(map, n) > 0; ++step) {
    }
  }
}

}  // namespace lozenge
