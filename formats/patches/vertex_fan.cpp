#include "formats/patches/vertex_fan.h"

#include <algorithm>
#include <utility>

namespace lozenge {

TrianglesAround::TrianglesAround(const ChartedSurface& surface)
    : first_(surface.positions.size() + 1, 0), changed_(surface.positions.size(), -1) {
  for (const ChartedTriangle& t : surface.triangles) {
    for (const ChartedCorner& corner : t.corners) ++first_[corner.vertex + 1];
  }
  for (std::size_t v = 0; v + 1 < first_.size(); ++v) first_[v + 1] += first_[v];
  all_.resize(3 * surface.triangles.size());
  std::vector<std::int32_t> next(first_.begin(), first_.end() - 1);
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    for (const ChartedCorner& corner : surface.triangles[t].corners) {
      all_[next[corner.vertex]++] = static_cast<std::int32_t>(t);
    }
  }
}

std::span<const std::int32_t> TrianglesAround::operator[](VertexId v) const {
  if (changed_[v] >= 0) return lists_[changed_[v]];
  return {all_.data() + first_[v], static_cast<std::size_t>(first_[v + 1] - first_[v])};
}

void TrianglesAround::replace(VertexId v, std::vector<std::int32_t> triangles) {
  if (changed_[v] < 0) {
    changed_[v] = static_cast<std::int32_t>(lists_.size());
    lists_.emplace_back();
  }
  lists_[changed_[v]] = std::move(triangles);
}

std::optional<VertexFan> fan_of(const ChartedSurface& surface, const TrianglesAround& around, VertexId v) {
  constexpr std::size_t kMost = 48;  // triangles; finding their order takes the square of that
  const std::span<const std::int32_t> triangles = around[v];
  if (triangles.empty() || triangles.size() > kMost) return std::nullopt;
  const auto start_of = [&](std::int32_t t) {
    const ChartedTriangle& triangle = surface.triangles[t];
    return triangle.corners[(corner_with(triangle, v) + 1) % 3].vertex;
  };
  const auto end_of = [&](std::int32_t t) {
    const ChartedTriangle& triangle = surface.triangles[t];
    return triangle.corners[(corner_with(triangle, v) + 2) % 3].vertex;
  };
  const auto starting_at = [&](VertexId rim) {
    return std::find_if(triangles.begin(), triangles.end(), [&](std::int32_t t) { return start_of(t) == rim; });
  };
  // An open fan begins where no triangle ends.
  std::int32_t first = triangles.front();
  VertexFan fan;
  fan.vertex = v;
  for (const std::int32_t t : triangles) {
    const bool follows = std::any_of(triangles.begin(), triangles.end(),
                                     [&](std::int32_t other) { return end_of(other) == start_of(t); });
    if (follows) continue;
    first = t;
    fan.closed = false;
  }
  for (std::int32_t t = first; fan.triangles.size() < triangles.size();) {
    fan.triangles.push_back(t);
    fan.corner.push_back(corner_with(surface.triangles[t], v));
    fan.rim.push_back(start_of(t));
    const auto next = starting_at(end_of(t));
    if (next == triangles.end()) break;
    t = *next;
    if (t == first) break;
  }
  if (fan.triangles.size() != triangles.size()) return std::nullopt;
  const VertexId last = end_of(fan.triangles.back());
  if (!fan.closed) fan.rim.push_back(last);
  if (fan.closed && last != fan.rim.front()) return std::nullopt;
  return fan;
}

}  // namespace lozenge
