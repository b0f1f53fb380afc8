// Edges are found by sorting half-edges by their two ends; what shares an edge lies side by side then. Two disjoint-set
// forests grow over them: vertices joined by edges (components), and corners of one vertex joined across edges (fans).
#include "formats/surface/mesh_statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "formats/base/disjoint_sets.h"

namespace lozenge {

namespace {

constexpr double kPi = 3.14159265358979323846;

struct HalfEdge {
  VertexId low;
  VertexId high;
  bool forward;         ///< runs from low to high
  std::int64_t corner;  ///< 3 triangle + side; the half-edge starts there
};

std::vector<HalfEdge> sorted_half_edges(const SurfaceView& surface) {
  std::vector<HalfEdge> half_edges;
  half_edges.reserve(surface.triangles.size() * 3);
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    for (int s = 0; s < 3; ++s) {
      const VertexId a = surface.triangles[t][s];
      const VertexId b = surface.triangles[t][(s + 1) % 3];
      half_edges.push_back({std::min(a, b), std::max(a, b), a < b, static_cast<std::int64_t>(3 * t + s)});
    }
  }
  std::sort(half_edges.begin(), half_edges.end(), [](const HalfEdge& x, const HalfEdge& y) {
    if (x.low != y.low) return x.low < y.low;
    if (x.high != y.high) return x.high < y.high;
    return x.corner < y.corner;
  });
  return half_edges;
}

/// The corners that a half-edge touches, that at the lower vertex first.
std::array<std::int64_t, 2> corners_of(const HalfEdge& h) {
  const std::int64_t start = h.corner;
  const std::int64_t end = start / 3 * 3 + (start % 3 + 1) % 3;
  return h.forward ? std::array{start, end} : std::array{end, start};
}

/// Gathers values; gives their spread.
class SpreadSum {
 public:
  void add(double x) { values_.push_back(x); }

  Spread spread() const {
    if (values_.empty()) return {};
    const auto n = static_cast<double>(values_.size());
    const double mean = std::accumulate(values_.begin(), values_.end(), 0.0) / n;
    if (!(mean > 0)) return {};
    double squares = 0;
    for (const double x : values_) squares += (x - mean) * (x - mean);
    const auto [low, high] = std::minmax_element(values_.begin(), values_.end());
    return {mean, 100 * std::sqrt(squares / n) / mean, 100 * *low / mean, 100 * *high / mean};
  }

 private:
  std::vector<double> values_;
};

double wedge(const Vec3d& at, const Vec3d& b, const Vec3d& c) {
  const Vec3d e = b - at;
  const Vec3d f = c - at;
  return std::atan2(e.cross(f).length(), e.dot(f));
}

void measure_triangles(const SurfaceView& surface, MeshStatistics& result) {
  SpreadSum areas;
  double smallest = kPi;
  double sum = 0;
  for (const auto& [a, b, c] : surface.triangles) {
    const Vec3d p(surface.positions[a]);
    const Vec3d q(surface.positions[b]);
    const Vec3d r(surface.positions[c]);
    areas.add((q - p).cross(r - p).length() / 2);
    const double angle = std::min({wedge(p, q, r), wedge(q, r, p), wedge(r, p, q)});
    smallest = std::min(smallest, angle);
    sum += angle;
  }
  result.area = areas.spread();
  if (surface.triangles.empty()) return;
  result.min_angle = smallest;
  result.mean_min_angle = sum / static_cast<double>(surface.triangles.size());
}

/// Edges, fans and components.
void measure_connectivity(const SurfaceView& surface, MeshStatistics& result) {
  const std::vector<HalfEdge> half_edges = sorted_half_edges(surface);
  DisjointSets<VertexId> components(surface.positions.size());
  DisjointSets<std::int64_t> fans(surface.triangles.size() * 3);
  std::vector<bool> on_boundary(surface.positions.size(), false);
  DisjointSets<VertexId> loops(surface.positions.size());
  SpreadSum lengths;
  for (std::size_t first = 0; first < half_edges.size();) {
    std::size_t end = first + 1;
    const HalfEdge& h = half_edges[first];
    while (end < half_edges.size() && half_edges[end].low == h.low && half_edges[end].high == h.high) ++end;
    ++result.edges;
    lengths.add((Vec3d(surface.positions[h.low]) - Vec3d(surface.positions[h.high])).length());
    components.join(h.low, h.high);
    if (end - first == 1) {
      ++result.boundary_edges;
      on_boundary[h.low] = on_boundary[h.high] = true;
      loops.join(h.low, h.high);
    } else if (end - first > 2 || h.low == h.high || h.forward == half_edges[first + 1].forward) {
      ++result.tangled_edges;
    }
    for (std::size_t i = first + 1; i < end; ++i) {
      const auto ours = corners_of(h);
      const auto theirs = corners_of(half_edges[i]);
      fans.join(ours[0], theirs[0]);
      fans.join(ours[1], theirs[1]);
    }
    first = end;
  }
  result.edge = lengths.spread();

  std::vector<std::int32_t> valence(surface.positions.size(), 0);
  std::vector<std::int32_t> fan_count(surface.positions.size(), 0);
  for (std::size_t c = 0; c < surface.triangles.size() * 3; ++c) {
    const VertexId v = surface.triangles[c / 3][c % 3];
    ++valence[v];
    if (fans.root(static_cast<std::int64_t>(c)) == static_cast<std::int64_t>(c)) ++fan_count[v];
  }
  const auto count = static_cast<VertexId>(valence.size());
  for (VertexId v = 0; v < count; ++v) {
    if (valence[v] == 0) continue;
    ++result.vertices;
    result.components += components.root(v) == v;
    result.boundary_loops += on_boundary[v] && loops.root(v) == v;
    if (fan_count[v] > 1) ++result.pinched_vertices;
    if (valence[v] != (on_boundary[v] ? 3 : 6)) ++result.irregular_vertices;
  }
}

}  // namespace

MeshStatistics mesh_statistics(const SurfaceView& surface) {
  MeshStatistics result;
  result.triangles = static_cast<std::int64_t>(surface.triangles.size());
  measure_connectivity(surface, result);
  measure_triangles(surface, result);
  result.euler = result.vertices - result.edges + result.triangles;
  if (result.vertices > 0) {
    result.irregular_percent =
        100.0 * static_cast<double>(result.irregular_vertices) / static_cast<double>(result.vertices);
  }
  return result;
}

}  // namespace lozenge
