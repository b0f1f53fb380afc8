// Charts of free corners are motions between frames, so one corner of an edge tells how two triangles hang together.
// Those of pinned corners tell positions only: where both ends are pinned, the motion is the one that takes the edge
// onto itself.
#include "stages/parameterize/map/images.h"

namespace lozenge {

UnitMotion motion_across(const WorkingMap& map, Halfedge h) {
  const Halfedge g = map.mesh.twins[h];
  const Halfedge end = next_in_triangle(h);
  const Halfedge start_there = next_in_triangle(g);
  const VertexId v = map.mesh.start(h);
  const VertexId w = map.mesh.start(end);
  if (map.pin[v] < 0) return composed(map.chart[start_there], inverse(map.chart[h]));
  if (map.pin[w] < 0) return composed(map.chart[g], inverse(map.chart[end]));
  return motion_of_segment(map.chart[h](map.at[v]), map.chart[end](map.at[w]), map.chart[start_there](map.at[v]),
                           map.chart[g](map.at[w]));
}

void gather_ring(const WorkingMap& map, VertexId v, Ring& ring) {
  ring.at.clear();
  ring.halfedges.clear();
  const auto add = [&](Halfedge spoke, Halfedge neighbour) {
    const Vec2d& at = map.at[map.mesh.start(neighbour)];
    const UnitMotion& mine = map.chart[spoke];
    const UnitMotion& its = map.chart[neighbour];
    ring.at.push_back(mine == its ? at : composed(inverse(mine), its)(at));
  };
  const Halfedge first = map.mesh.outgoing[v];
  Halfedge h = first;
  for (;;) {
    add(h, next_in_triangle(h));
    ring.halfedges.push_back(h);
    const Halfedge next = map.mesh.next_around(h);
    if (next < 0) add(h, previous_in_triangle(h));
    if (next < 0 || next == first) return;
    h = next;
  }
}

void triangles_around(const WorkingMap& map, const std::vector<VertexId>& vertices, Marks& marks,
                      std::vector<TriangleId>& triangles) {
  triangles.clear();
  marks.clear(map.mesh.triangles.size());
  for (const VertexId v : vertices) {
    for_each_outgoing(map.mesh, v, [&](Halfedge h) {
      if (marks.add(h / 3)) triangles.push_back(h / 3);
    });
  }
}

}  // namespace lozenge
