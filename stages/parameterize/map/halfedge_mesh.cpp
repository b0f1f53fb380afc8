// Twins are found among the half-edges that share their lower corner, sorted by counting.
#include "stages/parameterize/map/halfedge_mesh.h"

#include <algorithm>

#include "formats/base/parallel.h"

namespace lozenge {

HalfedgeMesh make_halfedge_mesh(const std::vector<std::array<VertexId, 3>>& triangles, std::int32_t vertex_count) {
  HalfedgeMesh mesh;
  mesh.triangles = triangles;
  mesh.twins.assign(triangles.size() * 3, -1);
  mesh.outgoing.assign(vertex_count, -1);

  // Half-edges sorted by their lower corner (a counting sort); the few that share it are paired by looking through
  // them.
  std::vector<std::int32_t> first(static_cast<std::size_t>(vertex_count) + 1, 0);
  const auto count = static_cast<Halfedge>(mesh.twins.size());
  const auto lower = [&](Halfedge h) { return std::min(mesh.start(h), mesh.end(h)); };
  for (Halfedge h = 0; h < count; ++h) ++first[lower(h) + 1];
  for (std::int32_t v = 0; v < vertex_count; ++v) first[v + 1] += first[v];
  std::vector<Halfedge> sorted(count);
  std::vector<std::int32_t> fill(first.begin(), first.end() - 1);
  for (Halfedge h = 0; h < count; ++h) sorted[fill[lower(h)]++] = h;
  const auto pair_at = [&](std::size_t v) {
    for (std::int32_t i = first[v]; i < first[v + 1]; ++i) {
      const Halfedge h = sorted[i];
      for (std::int32_t j = i + 1; j < first[v + 1] && mesh.twins[h] < 0; ++j) {
        const Halfedge g = sorted[j];
        if (mesh.twins[g] >= 0 || mesh.start(g) != mesh.end(h) || mesh.end(g) != mesh.start(h)) continue;
        mesh.twins[h] = g;
        mesh.twins[g] = h;
      }
    }
  };
  for_each_part(static_cast<std::size_t>(vertex_count), [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) pair_at(v);
  });
  for (Halfedge h = 0; h < count; ++h) {
    Halfedge& out = mesh.outgoing[mesh.start(h)];
    if (out < 0 || mesh.twins[h] < 0) out = h;
  }
  return mesh;
}

Halfedge cut_triangle(HalfedgeMesh& mesh, Halfedge h, VertexId m) {
  const Halfedge n = next_in_triangle(h);
  const VertexId b = mesh.end(h);
  const VertexId c = mesh.opposite(h);
  const auto first = static_cast<Halfedge>(mesh.twins.size());
  const Halfedge beyond = mesh.twins[n];
  mesh.triangles.push_back({m, b, c});
  mesh.twins.insert(mesh.twins.end(), {-1, beyond, n});
  if (beyond >= 0) mesh.twins[beyond] = first + 1;
  mesh.twins[n] = first + 2;
  mesh.twins[h] = -1;
  mesh.triangles[h / 3][n % 3] = m;
  // Where b's half-edge was the one that is gone, its next is as good.
  if (mesh.outgoing[b] == n) mesh.outgoing[b] = first + 1;
  return first;
}

VertexId split_edge(HalfedgeMesh& mesh, Halfedge h) {
  const Halfedge g = mesh.twins[h];
  const auto m = static_cast<VertexId>(mesh.outgoing.size());
  mesh.outgoing.push_back(-1);
  const Halfedge left = cut_triangle(mesh, h, m);
  mesh.outgoing[m] = left;
  if (g < 0) return m;
  const Halfedge right = cut_triangle(mesh, g, m);
  mesh.twins[h] = right;
  mesh.twins[right] = h;
  mesh.twins[g] = left;
  mesh.twins[left] = g;
  return m;
}

Halfedge first_of_fan(const HalfedgeMesh& mesh, Halfedge h) {
  for (Halfedge here = h;;) {
    const Halfedge before = mesh.previous_around(here);
    if (before < 0) return here;
    if (before == h) return h;
    here = before;
  }
}

Halfedge last_of_fan(const HalfedgeMesh& mesh, Halfedge h) {
  for (Halfedge here = h;;) {
    const Halfedge next = mesh.next_around(here);
    if (next < 0 || next == h) return here;
    here = next;
  }
}

}  // namespace lozenge
