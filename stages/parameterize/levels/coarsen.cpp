// `simplify` says which vertex goes next. The triangles of the one removed now end in the other end of its edge, whose
// chart the two dead triangles tell; where one of them comes out folded, the removal is taken back.
#include "stages/parameterize/levels/coarsen.h"

#include "stages/parameterize/levels/simplify.h"
#include "stages/parameterize/map/homes.h"
#include "stages/parameterize/map/images.h"

#include <algorithm>

namespace lozenge {

std::vector<Removal> coarsen(WorkingMap& map, std::int32_t triangles) {
  RemovalGuard guard;
  guard.may_remove = [&](VertexId v) { return map.pin[v] < 0; };
  guard.removed = [&](const Removal& removal) {
    // The dead triangles still have the charts of both ends of the edge.
    const Halfedge edge = removal.left >= 0 ? removal.left : removal.right;
    const UnitMotion end_seen_from_start = composed(inverse(map.chart[edge]), map.chart[next_in_triangle(edge)]);
    const UnitMotion kept_seen_from_removed = removal.left >= 0 ? end_seen_from_start : inverse(end_seen_from_start);
    const Hole hole = hole_of(map.mesh, removal);
    std::vector<std::pair<Halfedge, UnitMotion>> before;
    for (Halfedge out = hole.first;; out = map.mesh.next_around(out)) {
      before.emplace_back(out, map.chart[out]);
      map.chart[out] = composed(map.chart[out], kept_seen_from_removed);
      if (out == hole.last) break;
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
