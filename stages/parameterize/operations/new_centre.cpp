// While a region holds few vertices, the centre is the vertex nearest in space to where the new domain vertex is
// embedded. Then it is, of those nearest to the polygon's middle, the one that leaves regions and paths around it most
// even.
#include "stages/parameterize/operations/new_centre.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace lozenge {

namespace {

/// How uneven the regions and paths around the new vertex would be with its centre at `centre` (Sec. 5.3): the spread
/// of the areas of its slices, and of the lengths of its spokes, each as a share of their mean. Lengths follow equation
/// (5) in the polygon.
double unevenness(const WorkingMap& map, const SurfaceMeasures& measures, const StarLayout& layout,
                  const Numbering& index, const StarPolygon& polygon, const Vec2d& centre) {
  const int k = polygon.slices;
  std::vector<Vec2d> rim;
  for (int m = 0; m < (polygon.is_half ? k + 1 : k); ++m) rim.push_back(polygon.corner(m) - centre);
  std::vector<int> slice(layout.vertices.size());
  std::vector<double> area(k, 0), length(k, 0);
  for (std::size_t i = 0; i < slice.size(); ++i) {
    const Vec2d p = layout.at[i] - centre;
    int best = 0;
    for (int m = 0; m < k; ++m) {
      if (cross(rim[m], p) >= 0 && cross(p, rim[polygon.after(m)]) >= 0) best = m;
    }
    slice[i] = best;
    area[best] += measures.vertex_area[layout.vertices[i]];
  }
  for (std::size_t i = 0; i < slice.size(); ++i) {
    for_each_outgoing(map.mesh, layout.vertices[i], [&](Halfedge h) {
      const VertexId u = map.mesh.end(h), w = map.mesh.opposite(h);
      const int p = index.find(u);
      const int q = index.find(w);
      if (p < 0 || q < 0 || slice[p] != slice[q] || slice[p] == slice[i]) return;
      int spoke = -1;
      if (polygon.after(slice[p]) == slice[i]) spoke = slice[i];
      else if (polygon.after(slice[i]) == slice[p]) spoke = slice[p];
      const Vec2d e = layout.at[q] - layout.at[p];
      if (spoke < 0 || !(e.length() > 0)) return;
      const double in_space = Vec3d((*map.positions)[u] - (*map.positions)[w]).length();
      length[spoke] += in_space * std::abs(e.normalized().dot(rim[spoke].normalized())) / 2;
    });
  }
  const auto spread = [](const std::vector<double>& values) {
    double sum = 0;
    for (const double x : values) sum += x;
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    return sum > 0 ? (*high - *low) * static_cast<double>(values.size()) / sum : 0;
  };
  return spread(area) + spread(length);
}

}  // namespace

std::vector<std::size_t> rank_centres(const WorkingMap& map, const SurfaceMeasures& measures, const StarLayout& layout,
                                      const StarPolygon& polygon, const Vec3d& embedded, Numbering& places) {
  constexpr std::size_t kMostCandidates = 6;  // each that is carried out costs as much as the collapse
  const std::size_t n = layout.vertices.size();
  std::vector<std::pair<double, std::size_t>> ranked;
  ranked.reserve(n);
  const bool warm = n > static_cast<std::size_t>(polygon.slices) * kWarmVertices / 3;
  for (std::size_t i = 0; i < n; ++i) {
    if (!may_be_centre(map, polygon, layout, i)) continue;
    const double distance =
        warm ? layout.at[i].length2() : (Vec3d((*map.positions)[layout.vertices[i]]) - embedded).length2();
    ranked.emplace_back(distance, i);
  }
  const std::size_t kept = std::min(ranked.size(), kMostCandidates);
  std::partial_sort(ranked.begin(), ranked.begin() + static_cast<std::ptrdiff_t>(kept), ranked.end());
  ranked.resize(kept);
  if (warm) {
    places.clear(map.home.size());
    for (std::size_t i = 0; i < n; ++i) places.set(layout.vertices[i], static_cast<std::int32_t>(i));
    for (auto& [score, i] : ranked) score = unevenness(map, measures, layout, places, polygon, layout.at[i]);
    std::sort(ranked.begin(), ranked.end());
  }
  std::vector<std::size_t> order;
  for (const auto& candidate : ranked) order.push_back(candidate.second);
  return order;
}

}  // namespace lozenge
