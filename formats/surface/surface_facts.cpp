// Half-edges are put into one bucket for each vertex, the lower one of their two, and each bucket is sorted by the
// other vertex: what joins the same two vertices then lies side by side. Flat arrays, and the same result on any
// machine.
#include "formats/surface/surface_facts.h"

#include <algorithm>
#include <numeric>
#include <span>

#include "formats/base/disjoint_sets.h"
#include "formats/base/parallel.h"

namespace lozenge {

namespace {

/// Half-edges by the lower of their two vertices: those of vertex v are items[first[v]] up to items[first[v + 1]].
struct Buckets {
  std::vector<HalfEdge> first;
  std::vector<HalfEdge> items;
};

VertexId lower_end(const SourceMesh& mesh, HalfEdge h) {
  return std::min(half_edge_start(mesh, h), half_edge_end(mesh, h));
}
VertexId upper_end(const SourceMesh& mesh, HalfEdge h) {
  return std::max(half_edge_start(mesh, h), half_edge_end(mesh, h));
}

Buckets bucket_half_edges(const SourceMesh& mesh) {
  const auto count = static_cast<HalfEdge>(3 * mesh.triangles.size());
  Buckets buckets;
  buckets.first.assign(mesh.positions.size() + 2, 0);
  // Counts are kept one place ahead, so that filling the buckets leaves their starts behind.
  for (HalfEdge h = 0; h < count; ++h) ++buckets.first[lower_end(mesh, h) + 2];
  std::partial_sum(buckets.first.begin(), buckets.first.end(), buckets.first.begin());
  buckets.items.resize(static_cast<std::size_t>(count));
  for (HalfEdge h = 0; h < count; ++h) buckets.items[buckets.first[lower_end(mesh, h) + 1]++] = h;
  return buckets;
}

/// Links all half-edges of one edge.
void link_edge(const SourceMesh& mesh, std::span<const HalfEdge> edge, std::vector<HalfEdge>& twins) {
  if (edge.size() != 2) {
    for (const HalfEdge h : edge) twins[h] = edge.size() == 1 ? kNoTwin : kCrowdedTwin;
    return;
  }
  const bool opposite = half_edge_start(mesh, edge[0]) != half_edge_start(mesh, edge[1]);
  twins[edge[0]] = opposite ? edge[1] : same_direction_twin(edge[1]);
  twins[edge[1]] = opposite ? edge[0] : same_direction_twin(edge[0]);
}

/// Links the half-edges of one bucket. \return the number of edges
std::int64_t link_bucket(const SourceMesh& mesh, std::span<HalfEdge> bucket, std::vector<HalfEdge>& twins) {
  std::sort(bucket.begin(), bucket.end(), [&](HalfEdge g, HalfEdge h) {
    const VertexId a = upper_end(mesh, g);
    const VertexId b = upper_end(mesh, h);
    return a != b ? a < b : g < h;
  });
  std::int64_t edges = 0;
  for (std::size_t begin = 0; begin < bucket.size(); ++edges) {
    std::size_t end = begin + 1;
    while (end < bucket.size() && upper_end(mesh, bucket[end]) == upper_end(mesh, bucket[begin])) ++end;
    link_edge(mesh, bucket.subspan(begin, end - begin), twins);
    begin = end;
  }
  return edges;
}

/// Sets of vertices that triangles hang together, those of no triangle left out.
std::int64_t count_components(const SourceMesh& mesh) {
  DisjointSets<VertexId> sets(mesh.positions.size());
  std::vector<bool> used(mesh.positions.size(), false);
  for (const auto& [a, b, c] : mesh.triangles) {
    sets.join(a, b);
    sets.join(a, c);
    used[a] = used[b] = used[c] = true;
  }
  std::int64_t components = 0;
  for (std::size_t v = 0; v < used.size(); ++v) {
    components += used[v] && sets.root(static_cast<VertexId>(v)) == static_cast<VertexId>(v);
  }
  return components;
}

/// Sets of vertices that boundary edges hang together. On a manifold each is a loop.
std::int64_t count_boundary_loops(const SourceMesh& mesh, const std::vector<HalfEdge>& boundary) {
  if (boundary.empty()) return 0;
  DisjointSets<VertexId> sets(mesh.positions.size());
  std::int64_t joined = 0;
  std::int64_t vertices = 0;
  std::vector<bool> seen(mesh.positions.size(), false);
  for (const HalfEdge h : boundary) {
    for (const VertexId v : {half_edge_start(mesh, h), half_edge_end(mesh, h)}) {
      vertices += !seen[v];
      seen[v] = true;
    }
    joined += sets.join(half_edge_start(mesh, h), half_edge_end(mesh, h));
  }
  return vertices - joined;
}

}  // namespace

HalfEdgeLinks link_half_edges(const SourceMesh& mesh) {
  HalfEdgeLinks links;
  links.twins.resize(3 * mesh.triangles.size());
  Buckets buckets = bucket_half_edges(mesh);
  links.edges = sum_of_parts(mesh.positions.size(), [&](std::size_t begin, std::size_t end) {
    std::int64_t edges = 0;
    for (std::size_t v = begin; v < end; ++v) {
      edges += link_bucket(mesh, {buckets.items.data() + buckets.first[v], buckets.items.data() + buckets.first[v + 1]},
                           links.twins);
    }
    return edges;
  });
  return links;
}

SurfaceFacts surface_facts(const SourceMesh& mesh) { return surface_facts(mesh, link_half_edges(mesh)); }

SurfaceFacts surface_facts(const SourceMesh& mesh, const HalfEdgeLinks& links) {
  SurfaceFacts facts;
  facts.vertices = static_cast<std::int64_t>(mesh.positions.size());
  facts.triangles = static_cast<std::int64_t>(mesh.triangles.size());
  facts.components = count_components(mesh);
  facts.euler = facts.vertices - links.edges + facts.triangles;
  std::vector<HalfEdge> boundary;
  for (std::size_t h = 0; h < links.twins.size(); ++h) {
    if (links.twins[h] == kNoTwin) boundary.push_back(static_cast<HalfEdge>(h));
  }
  facts.boundary_edges = static_cast<std::int64_t>(boundary.size());
  facts.boundary_loops = count_boundary_loops(mesh, boundary);
  return facts;
}

}  // namespace lozenge
