#include "stages/import/leave_out.h"

#include <algorithm>
#include <numeric>

#include "formats/surface/attribute_streams.h"
#include "formats/surface/surface_facts.h"
#include "stages/import/duplicates.h"
#include "stages/import/pieces.h"

namespace lozenge {

namespace {

Vec3f first_corner(const SourceMesh& mesh, std::size_t t) { return mesh.positions[mesh.triangles[t][0]]; }

template <typename T>
void keep_marked(std::vector<T>& triangles, const std::vector<bool>& keep) {
  if (triangles.empty()) return;
  std::size_t kept = 0;
  for (std::size_t t = 0; t < keep.size(); ++t) {
    if (keep[t]) triangles[kept++] = triangles[t];
  }
  triangles.resize(kept);
}

/// Half-edges of each edge, counted by their direction.
struct EdgeCounts {
  std::vector<std::int32_t> edge_of;               ///< [half-edge]
  std::vector<std::array<std::int32_t, 2>> count;  ///< [edge] running up, from the lower vertex to the higher; and down

  std::int32_t& along(const SourceMesh& mesh, HalfEdge h) {
    return count[edge_of[h]][half_edge_start(mesh, h) < half_edge_end(mesh, h) ? 0 : 1];
  }
  std::int32_t total(HalfEdge h) const { return count[edge_of[h]][0] + count[edge_of[h]][1]; }
};

EdgeCounts count_edges(const SourceMesh& mesh) {
  std::vector<HalfEdge> order(3 * mesh.triangles.size());
  std::iota(order.begin(), order.end(), 0);
  const auto ends = [&](HalfEdge h) {
    const VertexId a = half_edge_start(mesh, h);
    const VertexId b = half_edge_end(mesh, h);
    return std::pair(std::min(a, b), std::max(a, b));
  };
  std::sort(order.begin(), order.end(),
            [&](HalfEdge g, HalfEdge h) { return std::pair(ends(g), g) < std::pair(ends(h), h); });
  EdgeCounts counts;
  counts.edge_of.resize(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool fresh = i == 0 || ends(order[i]) != ends(order[i - 1]);
    if (fresh) counts.count.push_back({0, 0});
    counts.edge_of[order[i]] = static_cast<std::int32_t>(counts.count.size()) - 1;
    ++counts.along(mesh, order[i]);
  }
  return counts;
}

void mark_spare_flats(const SourceMesh& mesh, std::vector<bool>& keep, RepairReport& report) {
  const auto count = static_cast<TriangleId>(mesh.triangles.size());
  std::vector<TriangleId> flats;
  for (TriangleId t = 0; t < count; ++t) {
    if (is_flat(mesh, t)) flats.push_back(t);
  }
  if (flats.empty()) return;
  EdgeCounts counts = count_edges(mesh);
  for (const TriangleId t : flats) {
    bool spare = true;
    for (HalfEdge h = 3 * t; h < 3 * t + 3; ++h) {
      const std::int32_t same = counts.along(mesh, h);
      spare = spare && counts.total(h) != 2 && 2 * same > counts.total(h);
    }
    if (!spare) continue;
    for (HalfEdge h = 3 * t; h < 3 * t + 3; ++h) --counts.along(mesh, h);
    keep[t] = false;
    report.add(RepairKind::kFlatTriangles, first_corner(mesh, t));
  }
}

}  // namespace

void leave_out(SourceMesh& mesh, const std::vector<bool>& keep) {
  keep_triangles(mesh.corner_attributes, keep);
  keep_marked(mesh.materials, keep);
  keep_marked(mesh.triangles, keep);
}

bool is_flat(const SourceMesh& mesh, TriangleId t) {
  // Sine of the smallest angle between two sides. Differences of floats are exact in double but for very different
  // sizes, and their products are off by 2^-53.
  constexpr double kFlat = 1e-12;
  const Vec3d a(mesh.positions[mesh.triangles[t][0]]);
  const Vec3d u = Vec3d(mesh.positions[mesh.triangles[t][1]]) - a;
  const Vec3d v = Vec3d(mesh.positions[mesh.triangles[t][2]]) - a;
  return u.cross(v).length() <= kFlat * std::max({u.length2(), v.length2(), (u - v).length2()});
}

void leave_out_superfluous_triangles(SourceMesh& mesh, RepairReport& report) {
  part_duplicates(mesh, report);
  std::vector<bool> keep(mesh.triangles.size(), true);
  mark_spare_flats(mesh, keep, report);
  leave_out(mesh, keep);
}

void leave_out_flat_pieces(SourceMesh& mesh, RepairReport& report) {
  const auto count = static_cast<TriangleId>(mesh.triangles.size());
  const std::vector<VertexId> pieces = pieces_of(mesh);
  std::vector<bool> has_area(pieces.size(), false);
  for (TriangleId t = 0; t < count; ++t) {
    if (!is_flat(mesh, t)) has_area[pieces[mesh.triangles[t][0]]] = true;
  }
  std::vector<bool> keep(mesh.triangles.size());
  for (TriangleId t = 0; t < count; ++t) {
    keep[t] = has_area[pieces[mesh.triangles[t][0]]];
    if (!keep[t]) report.add(RepairKind::kFlatTriangles, first_corner(mesh, static_cast<std::size_t>(t)));
  }
  leave_out(mesh, keep);
}

}  // namespace lozenge
