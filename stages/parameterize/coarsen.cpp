#include <algorithm>

#include "stages/parameterize/levels.h"

namespace lozenge {

std::vector<Removal> coarsen(WorkingMap& map, std::int32_t triangles) {
  RemovalGuard guard;
  guard.may_remove = [&](VertexId v) { return map.pin[v] < 0; };
  guard.removed = [&](const Removal& removal) {
    // The dead triangles still know their neighbours, and both ends of the half-edge.
    const Halfedge h = removal.halfedge;
    const Halfedge first = map.mesh.twins[previous_in_triangle(h)];
    const Halfedge last = map.mesh.twins[next_in_triangle(map.mesh.twins[h])];
    const UnitMotion kept_seen_from_removed = composed(inverse(map.chart[h]), map.chart[next_in_triangle(h)]);
    std::vector<std::pair<Halfedge, UnitMotion>> before;
    for (Halfedge out = first;; out = map.mesh.next_around(out)) {
      before.emplace_back(out, map.chart[out]);
      map.chart[out] = composed(map.chart[out], kept_seen_from_removed);
      if (previous_in_triangle(out) == last) break;
    }
    const bool sound = std::all_of(before.begin(), before.end(),
                                   [&](const auto& b) { return doubled_image_area(map, b.first / 3) > 0; });
    if (sound) set_home(map, removal.vertex, -1, Vec2d(0, 0));
    else
      for (const auto& [out, chart] : before) map.chart[out] = chart;
    return sound;
  };
  std::vector<Removal> removals = simplify(map.mesh, *map.positions, triangles, guard);
  measure_rest_shapes(map);
  return removals;
}

}  // namespace lozenge
