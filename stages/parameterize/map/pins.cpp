// A pinned vertex has the home and the position of its domain vertex's corner. Let go of at a regular one, it needs
// charts with rotations again: a free neighbour sees it along a straight line, which tells the first, and turning
// around the vertex from triangle to triangle tells the others.
#include "stages/parameterize/map/pins.h"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "stages/parameterize/map/boundary.h"
#include "stages/parameterize/map/homes.h"
#include "stages/parameterize/map/images.h"
#include "stages/parameterize/map/walk.h"

namespace lozenge {

void pin_to(WorkingMap& map, VertexId v, DomainVertex corner) {
  const DomainCorner c = map.corner_of[corner];
  set_home(map, v, c.triangle, corner_position(c.corner));
  map.pin[v] = corner;
  map.anchor[corner] = v;
}

void unpin(WorkingMap& map, VertexId v) {
  if (map.pin[v] < 0) return;
  map.anchor[map.pin[v]] = -1;
  map.pin[v] = -1;
}

int corner_of_pinned(const WorkingMap& map, VertexId v) {
  const auto w = barycentrics(map.at[v]);
  return static_cast<int>(std::max_element(w.begin(), w.end()) - w.begin());
}

void renew_pin(WorkingMap& map, VertexId v) {
  const DomainCorner c = map.corner_of[map.pin[v]];
  const UnitPoint step = corner_step(corner_of_pinned(map, v));
  for_each_outgoing(map.mesh, v, [&](Halfedge h) { map.chart[h] = chart_of_pinned(c.corner, map.chart[h](step)); });
  set_home(map, v, c.triangle, corner_position(c.corner));
}

int corner_there(const Domain& domain, DomainTriangleId home, const Vec2d& at, DomainVertex n) {
  for (int c = 0; c < 3; ++c) {
    if (domain.corner(home, c) == n && (at - corner_position(c)).length2() < kSamePoint) return c;
  }
  return -1;
}

namespace {

/// The chart of a vertex over one of its half-edges, as the straight line from the neighbour there tells it.
struct ChartOverSpoke {
  Halfedge spoke = -1;
  UnitMotion chart;  ///< from the frame of `place.home` into that of the triangle of the spoke
  LineEnd place;
};

/// Seen from a neighbour that is free, the straight way to a vertex pinned to n ends in one of the triangles around n.
std::optional<ChartOverSpoke> seen_from_a_neighbour(const WorkingMap& map, VertexId v, DomainVertex n) {
  const Halfedge start = map.mesh.outgoing[v];
  for (Halfedge spoke = start; spoke >= 0;) {
    const Halfedge next = map.mesh.next_around(spoke);
    for (const Halfedge neighbour : {next_in_triangle(spoke), previous_in_triangle(spoke)}) {
      // The other one is seen over the next spoke, where there is one.
      if (neighbour != next_in_triangle(spoke) && next >= 0) continue;
      const VertexId w = map.mesh.start(neighbour);
      if (map.pin[w] >= 0) continue;
      const Vec2d target = inverse(map.chart[neighbour])(map.chart[spoke](map.at[v]));
      const auto walked = walk(map.domain, map.home[w], map.at[w], target);
      if (!walked || corner_there(map.domain, walked->home, walked->at, n) < 0) continue;
      return ChartOverSpoke{spoke, composed(map.chart[neighbour], walked->back), *walked};
    }
    spoke = next;
    if (spoke == start) break;
  }
  return std::nullopt;
}

}  // namespace

bool free_regular_vertex(WorkingMap& map, VertexId v) {
  const DomainVertex n = map.pin[v];
  if (map.kept[n]) return false;
  const auto seen = seen_from_a_neighbour(map, v, n);
  if (!seen) return false;
  std::vector<std::pair<Halfedge, UnitMotion>> charts{{seen->spoke, seen->chart}};
  const Halfedge end = last_of_fan(map.mesh, seen->spoke);
  for (Halfedge h = seen->spoke; h != end;) {
    const UnitMotion across = motion_across(map, previous_in_triangle(h));
    h = map.mesh.next_around(h);
    charts.emplace_back(h, composed(across, charts.back().second));
  }
  if (const Halfedge closing = previous_in_triangle(end); map.mesh.twins[closing] >= 0) {
    if (!(composed(motion_across(map, closing), charts.back().second) == seen->chart)) return false;
  }
  UnitMotion chart = seen->chart;
  for (Halfedge h = seen->spoke; map.mesh.on_boundary(v) && map.mesh.twins[h] >= 0;) {
    chart = composed(motion_across(map, h), chart);
    h = map.mesh.previous_around(h);
    charts.emplace_back(h, chart);
  }
  unpin(map, v);
  const int corner = corner_there(map.domain, seen->place.home, seen->place.at, n);
  set_home(map, v, seen->place.home, corner_position(corner));
  for (const auto& [h, motion] : charts) map.chart[h] = motion;
  if (map.mesh.on_boundary(v)) move_to_first_of_fan(map, v, {seen->place.home, corner});
  return true;
}

}  // namespace lozenge
