// Two triangles die with an edge, and their arrays keep what they knew: which triangles were beside them, so where the
// hole is that the vertex goes back into. As long as removals are undone in reverse, that stays true.
#include "stages/parameterize/levels/removal.h"

#include <algorithm>
#include <initializer_list>

namespace lozenge {

namespace {

bool ends_at(const HalfedgeMesh& mesh, std::initializer_list<VertexId> vertices) {
  return std::any_of(vertices.begin(), vertices.end(),
                     [&](VertexId v) { return v >= 0 && mesh.outgoing[v] >= 0 && mesh.on_boundary(v); });
}

/// Where the vertices lie on a boundary, their outgoing half-edge becomes the first of its fan again.
void find_first_of_fans(HalfedgeMesh& mesh, std::initializer_list<VertexId> vertices) {
  for (const VertexId v : vertices) {
    if (v >= 0) mesh.outgoing[v] = first_of_fan(mesh, mesh.outgoing[v]);
  }
}

/// Makes two half-edges twins; either may be beyond a boundary.
void join(HalfedgeMesh& mesh, Halfedge a, Halfedge b) {
  if (a >= 0) mesh.twins[a] = b;
  if (b >= 0) mesh.twins[b] = a;
}

/// Gives a fan's triangles another vertex in its middle.
void set_corner(HalfedgeMesh& mesh, const Hole& fan, VertexId v) {
  for (Halfedge out = fan.first;; out = mesh.next_around(out)) {
    mesh.triangles[out / 3][out % 3] = v;
    if (out == fan.last) return;
  }
}

}  // namespace

OppositeCorners opposite_corners(const HalfedgeMesh& mesh, const Removal& r) {
  return {r.left >= 0 ? mesh.opposite(r.left) : -1, r.right >= 0 ? mesh.opposite(r.right) : -1};
}

VertexId end_of(const HalfedgeMesh& mesh, const Removal& r) {
  return r.left >= 0 ? mesh.end(r.left) : mesh.start(r.right);
}

void remove_vertex(HalfedgeMesh& mesh, const Removal& r) {
  const VertexId v = r.vertex;
  const VertexId u = end_of(mesh, r);
  const Hole hole{r.left >= 0 ? mesh.next_around(r.left) : mesh.outgoing[v],
                  r.right >= 0 ? mesh.previous_around(next_in_triangle(r.right)) : last_of_fan(mesh, r.left)};
  const OppositeCorners sides = opposite_corners(mesh, r);
  const bool ends_here = ends_at(mesh, {v, u, sides.left, sides.right});
  set_corner(mesh, hole, u);
  mesh.outgoing[v] = -1;
  mesh.outgoing[u] = hole.first;
  if (r.left >= 0) {
    const Halfedge beyond = mesh.twins[next_in_triangle(r.left)];
    join(mesh, beyond, hole.first);
    mesh.outgoing[sides.left] = beyond >= 0 ? beyond : next_in_triangle(hole.first);
    mesh.triangles[r.left / 3] = {-1, -1, -1};
  }
  if (r.right >= 0) {
    const Halfedge spoke = previous_in_triangle(hole.last);
    join(mesh, mesh.twins[previous_in_triangle(r.right)], spoke);
    mesh.outgoing[sides.right] = spoke;
    mesh.triangles[r.right / 3] = {-1, -1, -1};
  }
  if (ends_here) find_first_of_fans(mesh, {u, sides.left, sides.right});
}

Hole hole_of(const HalfedgeMesh& mesh, const Removal& r) {
  // The dead triangles still know their neighbours.
  Hole hole;
  if (r.left >= 0) hole.first = mesh.twins[previous_in_triangle(r.left)];
  if (r.right >= 0) hole.last = mesh.previous_around(next_in_triangle(r.right));
  if (r.left < 0) hole.first = first_of_fan(mesh, hole.last);
  if (r.right < 0) hole.last = last_of_fan(mesh, hole.first);
  return hole;
}

void undo_removal(HalfedgeMesh& mesh, const Removal& r) {
  const Hole hole = hole_of(mesh, r);
  const VertexId v = r.vertex;
  const VertexId u = mesh.start(hole.first);
  const VertexId left = r.left >= 0 ? mesh.end(hole.first) : -1;
  const VertexId right = r.right >= 0 ? mesh.opposite(hole.last) : -1;
  const bool ends_here = ends_at(mesh, {u, left, right});
  const auto revive = [&](Halfedge h, VertexId a, VertexId b, VertexId c) {
    auto& corners = mesh.triangles[h / 3];
    corners[h % 3] = a;
    corners[(h % 3 + 1) % 3] = b;
    corners[(h % 3 + 2) % 3] = c;
    for (const Halfedge side : {next_in_triangle(h), previous_in_triangle(h)}) {
      if (mesh.twins[side] >= 0) mesh.twins[mesh.twins[side]] = side;
    }
  };
  set_corner(mesh, hole, v);
  if (r.left >= 0) revive(r.left, v, u, left);
  if (r.right >= 0) revive(r.right, u, v, right);
  mesh.outgoing[v] = r.left >= 0 ? r.left : hole.first;
  mesh.outgoing[u] = r.right >= 0 ? r.right : next_in_triangle(r.left);
  if (ends_here) find_first_of_fans(mesh, {v, u, left, right});
}

}  // namespace lozenge
