// Lists are linked both ways through arrays by vertex, so that a vertex changes lists in no time; it joins at the
// front.
#include "stages/parameterize/map/homes.h"

namespace lozenge {

void list_homes(WorkingMap& map) {
  map.first_in.assign(map.domain.triangles.size(), -1);
  map.next_in.assign(map.home.size(), -1);
  map.last_in.assign(map.home.size(), -1);
  map.listed = true;
  for (VertexId v = 0; v < map.mesh.vertex_count(); ++v) {
    const DomainTriangleId home = map.home[v];
    if (home < 0) continue;
    map.home[v] = -1;
    set_home(map, v, home, map.at[v]);
  }
}

std::vector<VertexId> vertices_by_triangle(const WorkingMap& map) {
  std::vector<VertexId> vertices;
  vertices.reserve(map.home.size());
  for (const VertexId first : map.first_in) {
    for (VertexId v = first; v >= 0; v = map.next_in[v]) vertices.push_back(v);
  }
  return vertices;
}

void set_home(WorkingMap& map, VertexId v, DomainTriangleId home, const Vec2d& at) {
  map.at[v] = at;
  if (map.home[v] == home) return;
  if (!map.listed) {
    map.home[v] = home;
    return;
  }
  if (map.home[v] >= 0) {
    const VertexId before = map.last_in[v];
    const VertexId after = map.next_in[v];
    (before >= 0 ? map.next_in[before] : map.first_in[map.home[v]]) = after;
    if (after >= 0) map.last_in[after] = before;
  }
  map.home[v] = home;
  map.last_in[v] = -1;
  map.next_in[v] = -1;
  if (home < 0) return;
  map.next_in[v] = map.first_in[home];
  if (map.first_in[home] >= 0) map.last_in[map.first_in[home]] = v;
  map.first_in[home] = v;
}

void move_home(WorkingMap& map, VertexId v, DomainTriangleId home, const Vec2d& at, const UnitMotion& back) {
  set_home(map, v, home, at);
  for_each_outgoing(map.mesh, v, [&](Halfedge h) { map.chart[h] = composed(map.chart[h], back); });
}

}  // namespace lozenge
