#include "stages/parameterize/levels.h"

namespace lozenge {

std::vector<Removal> coarsen(WorkingMap& map, std::int32_t triangles) {
  RemovalGuard guard;
  guard.may_remove = [&](VertexId v) { return map.pin[v] < 0; };
  guard.removed = [&](const Removal& removal) {
    const VertexId v = removal.vertex;
    const DomainTriangleId home = map.home[v];
    const Vec2d at = map.at[v];
    set_home(map, v, -1, Vec2d(0, 0));
    // The half-edge that was beyond the dead triangle now leaves the vertex that v was collapsed into.
    const VertexId kept = map.mesh.end(map.mesh.twins[next_in_triangle(removal.halfedge)]);
    if (is_sound(map, kept)) return true;
    set_home(map, v, home, at);
    return false;
  };
  std::vector<Removal> removals = simplify(map.mesh, *map.positions, triangles, guard);
  measure_rest_shapes(map);
  return removals;
}

}  // namespace lozenge
