// Steps on the domain: collapses, flips, and cones that crawl.
//
// What a step costs depends on the place. So an iteration takes the same few collapses or flips at every run, in places
// apart from one another, or all cones; the counter `each` is the mean of one, and `done` how many are not refused. A
// proxy has 40 mesh triangles for each domain triangle; the subjects have more, the more the larger they are, which
// shows how the steps grow with that. Items of collapses and flips are the source vertices at home in the stars that
// are carried along or relaxed; of crawling, cones.
#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "stages/parameterize/map/marks.h"
#include "stages/parameterize/map/star.h"
#include "stages/parameterize/operations/can_collapse.h"
#include "stages/parameterize/operations/collapse.h"
#include "stages/parameterize/operations/flip.h"
#include "stages/parameterize/relax/crawl.h"
#include "stages/parameterize/relax/sweeps.h"
#include "tools/bench/benchmarks.h"

namespace lozenge::bench {
namespace {

constexpr std::size_t kSteps = 8;

/// The side's ends, and the corners opposite: those that a flip would join.
std::array<DomainVertex, 4> diamond_of(const WorkingMap& map, DomainSide side) {
  const DomainSide across = map.domain.neighbour(side);
  return {map.domain.start(side), map.domain.end(side), map.domain.corner(side.triangle, (side.side + 2) % 3),
          map.domain.corner(across.triangle, (across.side + 2) % 3)};
}

/// Sides for which `can` holds, in the order of their numbers, whose diamonds have no corner in common.
std::vector<DomainSide> sides_apart(const WorkingMap& map, const std::function<bool(DomainSide)>& can) {
  std::vector<DomainSide> found;
  Marks taken;
  taken.clear(map.corner_of.size());
  for (DomainTriangleId t = 0; t < map.domain.size(); ++t) {
    for (int s = 0; s < 3 && map.domain.corner(t, 0) >= 0 && found.size() < kSteps; ++s) {
      const DomainSide side{t, s};
      const std::array<DomainVertex, 4> diamond = diamond_of(map, side);
      const bool is_apart = std::none_of(diamond.begin(), diamond.end(), [&](DomainVertex n) { return taken.has(n); });
      if (!is_apart || !can(side)) continue;
      for (const DomainVertex n : diamond) taken.add(n);
      found.push_back(side);
    }
  }
  return found;
}

/// Source vertices at home in the stars of the first `corners` of each side's diamond.
std::size_t vertices_around(const WorkingMap& map, const std::vector<DomainSide>& sides, std::size_t corners) {
  std::size_t count = 0;
  for (const DomainSide side : sides) {
    Marks counted;
    counted.clear(map.domain.triangles.size());
    const std::array<DomainVertex, 4> diamond = diamond_of(map, side);
    for (std::size_t n = 0; n < corners; ++n) {
      for (const DomainCorner& c : star_of(map, diamond[n])) {
        if (!counted.add(c.triangle)) continue;
        for (VertexId v = map.first_in[c.triangle]; v >= 0; v = map.next_in[v]) ++count;
      }
    }
  }
  return count;
}

/// \param done  those of all iterations that were not refused
void count_steps(benchmark::State& state, std::size_t steps, std::int64_t done) {
  using benchmark::Counter;
  state.counters["each"] = Counter(static_cast<double>(steps), Counter::kIsIterationInvariantRate | Counter::kInvert);
  state.counters["done"] = Counter(static_cast<double>(done), Counter::kAvgIterations);
}

/// Each collapse is taken back before the next.
void collapse_sides(benchmark::State& state, Subject& subject) {
  WorkingMap map = subject.optimized();
  SurfaceMeasures measures;
  measures.vertex_area = voronoi_areas(map);
  measures.embedding.assign(map.corner_of.size(), Vec3d(0, 0, 0));
  measures.warming_up = false;
  const std::vector<DomainSide> sides = sides_apart(map, [&](DomainSide side) { return can_collapse(map, side); });
  const std::size_t vertices = vertices_around(map, sides, 2);
  Scratch scratch;
  std::int64_t done = 0;
  while (state.KeepRunning()) {
    for (const DomainSide side : sides) {
      LocalChange change(map, scratch);
      const bool collapsed = collapse(change, measures, side, {kRelaxAround, false}).has_value();
      state.PauseTiming();
      change.take_back();
      done += collapsed;
      state.ResumeTiming();
    }
  }
  count_items(state, vertices);
  count_steps(state, sides.size(), done);
}

void flip_sides(benchmark::State& state, Subject& subject) {
  const WorkingMap& map = subject.optimized();
  const std::vector<DomainSide> sides = sides_apart(map, [&](DomainSide side) { return can_flip(map, side); });
  Scratch scratch;
  std::int64_t done = 0;
  measure_on_copies(
      state, [&] { return map; },
      [&](WorkingMap& copy) {
        for (const DomainSide side : sides) done += flip(copy, side, kRelaxAround, scratch).has_value();
      });
  count_items(state, vertices_around(map, sides, 4));
  count_steps(state, sides.size(), done);
}

/// The surface is stretched under its map, and the map relaxed: where it is as good as can be, every cone stays.
void crawl_cones(benchmark::State& state, Subject& subject) {
  constexpr float kStretch = 1.5F;
  constexpr int kSweeps = 50;  // cones feel only what has come near
  WorkingMap map = subject.optimized();
  std::vector<Vec3f> stretched = subject.mesh().positions;
  for (Vec3f& p : stretched) p.x *= kStretch;
  map.positions = &stretched;
  measure_rest_shapes(map);
  relax_all(map, {kSweeps, 0});
  std::vector<DomainVertex> cones;
  for (DomainVertex n = 0; n < static_cast<DomainVertex>(map.corner_of.size()); ++n) {
    if (map.corner_of[n].triangle >= 0 && map.anchor[n] >= 0 && !valence(map, n).is_regular()) cones.push_back(n);
  }
  Scratch scratch;
  std::int64_t done = 0;
  measure_on_copies(
      state, [&] { return map; },
      [&](WorkingMap& copy) {
        for (const DomainVertex n : cones) done += crawl(copy, n, scratch).has_value();
      });
  count_items(state, cones.size());
  count_steps(state, cones.size(), done);
}

}  // namespace

void add_domain_benchmarks(const SubjectPointer& subject) {
  add_benchmark("collapse", subject, collapse_sides);
  add_benchmark("flip", subject, flip_sides);
  add_benchmark("crawl", subject, crawl_cones);
}

}  // namespace lozenge::bench
