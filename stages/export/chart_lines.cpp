#include "stages/export/chart_lines.h"

#include <algorithm>
#include <cmath>

namespace lozenge {

ChartLines::ChartLines(const CollapsibleMesh& mesh, Lines lines)
    : mesh_(mesh), lines_(lines), kinds_(mesh.vertex_count(), VertexKind::kFree), has_feature_(mesh.vertex_count(), 0) {
  std::vector<std::uint8_t> line_edges(mesh.vertex_count(), 0);
  std::vector<std::uint8_t> features(mesh.vertex_count(), 0);
  const auto count = [](std::uint8_t& n) { n = static_cast<std::uint8_t>(std::min(3, n + 1)); };
  mesh.for_each_edge([&](VertexId a, VertexId b, const EdgeTriangles& at) {
    if (!mesh.is_line(a, b, at)) return;
    for (const VertexId v : {a, b}) {
      count(line_edges[v]);
      if (mesh.is_feature(at)) count(features[v]);
      if (at.count > 2) kinds_[v] = VertexKind::kFixed;
    }
  });
  for (std::size_t v = 0; v < line_edges.size(); ++v) {
    has_feature_[v] = features[v] != 0 ? 1 : 0;
    if (kinds_[v] == VertexKind::kFixed || line_edges[v] == 0) continue;
    const bool goes_on = features[v] == 0 || features[v] == 2;
    if (lines_ == Lines::kStay || !goes_on) kinds_[v] = VertexKind::kFixed;
    else kinds_[v] = line_edges[v] == 2 ? VertexKind::kOnLine : VertexKind::kCorner;
  }
  // Domain vertices of two patches look like places on a border, but borders turn there.
  for (const ChartedTriangle& t : mesh.triangles()) {
    for (const ChartedCorner& c : t.corners) {
      const auto is_end = [](double x) { return std::abs(x) < 1e-9 || std::abs(x - 1) < 1e-9; };
      if (!is_end(c.place.x) || !is_end(c.place.y)) continue;
      const bool may_go = lines_ == Lines::kSimplify && kinds_[c.vertex] != VertexKind::kFixed;
      kinds_[c.vertex] = may_go ? VertexKind::kCorner : VertexKind::kFixed;
    }
  }
}

bool ChartLines::keeps_squares(VertexId a, VertexId b, const EdgeTriangles& at) const {
  const VertexKind freer = std::min(kinds_[a], kinds_[b]);
  return freer == VertexKind::kFree || (freer == VertexKind::kOnLine && mesh_.is_line(a, b, at));
}

bool ChartLines::may_go(VertexId a, VertexId b, const EdgeTriangles& at, bool corners) const {
  if (std::min(kinds_[a], kinds_[b]) == VertexKind::kFixed) return false;
  // An edge from one place of a line that has a shape to another one of such a line would close what is between.
  if (has_feature_[a] != 0 && has_feature_[b] != 0 && !mesh_.is_feature(at)) return false;
  if (keeps_squares(a, b, at)) return true;
  return lines_ == Lines::kSimplify && corners;
}

bool ChartLines::stays(VertexId a, VertexId b) const {
  if (kinds_[a] == VertexKind::kFixed || kinds_[b] == VertexKind::kFixed) return kinds_[a] == VertexKind::kFixed;
  if (has_feature_[a] != has_feature_[b]) return has_feature_[a] > has_feature_[b];
  return kinds_[a] > kinds_[b];
}

void ChartLines::join(VertexId from, VertexId to, bool keeps_squares) {
  has_feature_[to] |= has_feature_[from];
  if (!keeps_squares) kinds_[to] = std::max(kinds_[to], VertexKind::kCorner);
}

}  // namespace lozenge
