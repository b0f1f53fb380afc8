#include "stages/import/part.h"

#include <algorithm>
#include <tuple>

#include "formats/surface/attribute_streams.h"
#include "stages/import/fans.h"

namespace lozenge {

namespace {

/// [vertex] whether it lies on an edge that isn't one of one or two triangles that agree.
std::vector<bool> ends_of_broken_edges(const SourceMesh& mesh, const HalfEdgeLinks& links) {
  std::vector<bool> is_end(mesh.positions.size(), false);
  for (std::size_t i = 0; i < links.twins.size(); ++i) {
    if (links.twins[i] >= kNoTwin) continue;
    const auto h = static_cast<HalfEdge>(i);
    is_end[half_edge_start(mesh, h)] = is_end[half_edge_end(mesh, h)] = true;
  }
  return is_end;
}

/// Splits edges while their half-edges go by the numbers that they had before.
class Divider {
 public:
  explicit Divider(SourceMesh& mesh) : mesh_(mesh), now_(3 * mesh.triangles.size()), before_(now_.size()) {
    for (std::size_t h = 0; h < now_.size(); ++h) now_[h] = before_[h] = static_cast<HalfEdge>(h);
  }

  /// \param across  its twin, or `kNoTwin`
  void divide(HalfEdge edge, HalfEdge across) {
    const HalfEdge h = now_[edge];
    const Vec3d a(mesh_.positions[half_edge_start(mesh_, h)]);
    const Vec3d b(mesh_.positions[half_edge_end(mesh_, h)]);
    const auto middle = static_cast<VertexId>(mesh_.positions.size());
    const Vec3f place((a + b) / 2);
    mesh_.positions.push_back({place.x + 0.0F, place.y + 0.0F, place.z + 0.0F});
    halve(h, middle);
    if (across >= 0) halve(now_[across], middle);
  }

 private:
  /// The triangle (a, b, c) at h = (a, b) becomes (a, middle, c), and (middle, b, c) is appended.
  void halve(HalfEdge h, VertexId middle) {
    const auto t = static_cast<std::size_t>(h / 3);
    const int s = h % 3;
    const int next = (s + 1) % 3;
    const VertexId b = mesh_.triangles[t][next];
    const VertexId c = mesh_.triangles[t][(s + 2) % 3];
    const auto fresh = static_cast<HalfEdge>(3 * mesh_.triangles.size());
    mesh_.triangles[t][next] = middle;
    mesh_.triangles.push_back({middle, b, c});
    halve_triangle(mesh_.corner_attributes, static_cast<std::size_t>(h));
    if (!mesh_.materials.empty()) mesh_.materials.push_back(mesh_.materials[t]);
    // The side (b, c) is now that of the new triangle.
    const HalfEdge moved = before_[3 * t + static_cast<std::size_t>(next)];
    before_.insert(before_.end(), {-1, moved, -1});
    before_[3 * t + static_cast<std::size_t>(next)] = -1;
    if (moved >= 0) now_[moved] = fresh + 1;
  }

  SourceMesh& mesh_;
  std::vector<HalfEdge> now_;     ///< [half-edge before] its number now
  std::vector<HalfEdge> before_;  ///< [half-edge now] its number before, or -1
};

}  // namespace

void part_vertices(SourceMesh& mesh, const std::vector<HalfEdge>& twins, const HalfEdgeLinks& links,
                   RepairReport& report) {
  const std::vector<bool> exempt = ends_of_broken_edges(mesh, links);
  const Fans fans = find_fans(mesh, twins);
  std::vector<std::int32_t> found(mesh.positions.size(), 0);
  std::vector<VertexId> vertices(fans.vertices);
  for (std::size_t f = 0; f < vertices.size(); ++f) {
    const VertexId v = fans.vertices[f];
    const std::int32_t earlier = found[v]++;
    if (earlier == 0) continue;
    if (earlier == 1 && !exempt[v]) report.add(RepairKind::kBowTieVertices, mesh.positions[v]);
    vertices[f] = static_cast<VertexId>(mesh.positions.size());
    mesh.positions.push_back(Vec3f(mesh.positions[v]));
  }
  for (std::size_t c = 0; c < fans.of_corner.size(); ++c) {
    mesh.triangles[c / 3][c % 3] = vertices[fans.of_corner[c]];
  }
}

void divide_double_edges(SourceMesh& mesh, const std::vector<HalfEdge>& twins, RepairReport& report) {
  const std::vector<HalfEdge> linked = link_half_edges(mesh).twins;
  // (ends, half-edge): one half-edge for each edge, the first.
  std::vector<std::tuple<VertexId, VertexId, HalfEdge>> edges;
  for (std::size_t i = 0; i < linked.size(); ++i) {
    const auto h = static_cast<HalfEdge>(i);
    if (linked[h] == twins[h] || (twins[h] >= 0 && twins[h] < h)) continue;
    const VertexId a = half_edge_start(mesh, h);
    const VertexId b = half_edge_end(mesh, h);
    edges.emplace_back(std::min(a, b), std::max(a, b), h);
  }
  if (edges.empty()) return;
  std::sort(edges.begin(), edges.end());
  Divider divider(mesh);
  for (std::size_t i = 1; i < edges.size(); ++i) {
    const auto& [low, high, h] = edges[i];
    const auto& [low_before, high_before, h_before] = edges[i - 1];
    if (low != low_before || high != high_before) continue;
    report.add(RepairKind::kDividedEdges, mesh.positions[low]);
    divider.divide(h, twins[h]);
  }
}

}  // namespace lozenge
