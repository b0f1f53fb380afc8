// Connectivity of a triangle mesh in flat arrays, which can be changed in place.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "formats/base/vector.h"

namespace lozenge {

/// Half-edge 3 t + s runs along side s of triangle t, from its corner s to its corner (s + 1) % 3.
using Halfedge = std::int32_t;

inline Halfedge next_in_triangle(Halfedge h) { return h % 3 == 2 ? h - 2 : h + 1; }
inline Halfedge previous_in_triangle(Halfedge h) { return h % 3 == 0 ? h + 2 : h - 1; }

/// Triangles, the twin of each half-edge (-1 on a boundary), and one outgoing half-edge of each vertex (-1 where it has
/// none: removed, or never used). Of a vertex on a boundary that is the first of its fan, the one that runs along the
/// boundary, so that turning counter-clockwise from it visits all. A removed triangle has corners -1.
struct HalfedgeMesh {
  std::vector<std::array<VertexId, 3>> triangles;
  std::vector<Halfedge> twins;
  std::vector<Halfedge> outgoing;

  std::int32_t triangle_count() const { return static_cast<std::int32_t>(triangles.size()); }
  std::int32_t vertex_count() const { return static_cast<std::int32_t>(outgoing.size()); }
  VertexId start(Halfedge h) const { return triangles[h / 3][h % 3]; }
  VertexId end(Halfedge h) const { return start(next_in_triangle(h)); }
  VertexId opposite(Halfedge h) const { return start(previous_in_triangle(h)); }
  /// The next half-edge with the same start, counter-clockwise; -1 at a boundary.
  Halfedge next_around(Halfedge h) const { return twins[previous_in_triangle(h)]; }
  /// The one before it, clockwise; -1 at a boundary.
  Halfedge previous_around(Halfedge h) const { return twins[h] < 0 ? -1 : next_in_triangle(twins[h]); }
  bool on_boundary(VertexId v) const { return twins[outgoing[v]] < 0; }
  bool removed(TriangleId t) const { return triangles[t][0] < 0; }
};

/// \pre the triangles form an oriented manifold
HalfedgeMesh make_halfedge_mesh(const std::vector<std::array<VertexId, 3>>& triangles, std::int32_t vertex_count);

/// Cuts the triangle of h from the middle m of h to the corner opposite: (a, b, c) becomes (a, m, c), and (m, b, c) is
/// appended. Half-edge h now runs from a to m. \return the new triangle's first half-edge, from m to b; both have no
/// twin yet
Halfedge cut_triangle(HalfedgeMesh& mesh, Halfedge h, VertexId m);

/// Splits an edge in a new vertex, which is appended, and its two triangles (or one, on a boundary) by `cut_triangle`,
/// that of h first. \return the new vertex
VertexId split_edge(HalfedgeMesh& mesh, Halfedge h);

/// Calls visit(h) for every half-edge that leaves `v`, counter-clockwise.
template <typename Visit>
void for_each_outgoing(const HalfedgeMesh& mesh, VertexId v, Visit&& visit) {
  const Halfedge first = mesh.outgoing[v];
  Halfedge h = first;
  do {
    visit(h);
    h = mesh.next_around(h);
  } while (h != first && h >= 0);
}

/// Calls visit(w) for every neighbour of `v`, counter-clockwise: the ends of the half-edges that leave it, and on a
/// boundary the start of the one that arrives there.
template <typename Visit>
void for_each_neighbour(const HalfedgeMesh& mesh, VertexId v, Visit&& visit) {
  const Halfedge first = mesh.outgoing[v];
  Halfedge h = first;
  for (;;) {
    visit(mesh.end(h));
    const Halfedge next = mesh.next_around(h);
    if (next < 0) visit(mesh.opposite(h));
    if (next < 0 || next == first) return;
    h = next;
  }
}

/// The first half-edge of the fan of `h`, around its start: on a boundary the one without a twin, else h itself.
Halfedge first_of_fan(const HalfedgeMesh& mesh, Halfedge h);
/// The last one counter-clockwise from `h`: at a boundary the one before it, else the one before h.
Halfedge last_of_fan(const HalfedgeMesh& mesh, Halfedge h);

}  // namespace lozenge
