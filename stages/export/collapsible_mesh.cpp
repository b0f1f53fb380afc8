#include "stages/export/collapsible_mesh.h"

#include <algorithm>
#include <utility>

#include "formats/surface/attribute.h"

namespace lozenge {
namespace {

constexpr std::int32_t kNone = -1;
constexpr std::size_t kWidth = kInfluences.components;

int corner_with(const ChartedTriangle& t, VertexId v) {
  for (int k = 0; k < 3; ++k) {
    if (t.corners[k].vertex == v) return k;
  }
  return kNone;
}

}  // namespace

CollapsibleMesh::CollapsibleMesh(ChartedSurface surface)
    : surface_(std::move(surface)),
      positions_(surface_.positions.begin(), surface_.positions.end()),
      head_(positions_.size(), kNone),
      next_(3 * surface_.triangles.size(), kNone),
      alive_(surface_.triangles.size(), 1),
      left_(static_cast<std::int64_t>(surface_.triangles.size())) {
  for (std::int32_t c = static_cast<std::int32_t>(next_.size()) - 1; c >= 0; --c) {
    const VertexId v = corner(c).vertex;
    next_[c] = head_[v];
    head_[v] = c;
  }
}

std::array<Vec3d, 3> CollapsibleMesh::corners_of(const ChartedTriangle& t) const {
  return {positions_[t.corners[0].vertex], positions_[t.corners[1].vertex], positions_[t.corners[2].vertex]};
}

EdgeTriangles CollapsibleMesh::triangles_at(VertexId a, VertexId b) const {
  EdgeTriangles found;
  for_each_corner(a, [&](std::int32_t c) {
    if (corner_with(triangle(c / 3), b) == kNone) return;
    if (found.count < 2) found.triangle[found.count] = c / 3;
    ++found.count;
  });
  return found;
}

std::vector<VertexId> CollapsibleMesh::neighbours(VertexId v) const {
  std::vector<VertexId> found;
  for_each_corner(v, [&](std::int32_t c) {
    for (const ChartedCorner& other : triangle(c / 3).corners) {
      if (other.vertex != v) found.push_back(other.vertex);
    }
  });
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

/// Whether a vertex is the same place of the same chart and group in two of its triangles.
bool CollapsibleMesh::goes_on_at(VertexId v, std::int32_t s, std::int32_t t) const {
  const ChartedTriangle& a = triangle(s);
  const ChartedTriangle& b = triangle(t);
  return a.patch == b.patch && a.group == b.group &&
         a.corners[corner_with(a, v)].place == b.corners[corner_with(b, v)].place;
}

bool CollapsibleMesh::is_line(VertexId a, VertexId b, const EdgeTriangles& at) const {
  return at.count != 2 || !goes_on_at(a, at.triangle[0], at.triangle[1]) ||
         !goes_on_at(b, at.triangle[0], at.triangle[1]);
}

bool CollapsibleMesh::is_feature(const EdgeTriangles& at) const {
  return at.count == 1 || (at.count == 2 && triangle(at.triangle[0]).group != triangle(at.triangle[1]).group);
}

bool CollapsibleMesh::keeps_topology(const EdgeCollapse& edge) const {
  std::vector<VertexId> across;
  for (int k = 0; k < edge.at.count; ++k) {
    for (const ChartedCorner& c : triangle(edge.at.triangle[k]).corners) {
      if (c.vertex != edge.from && c.vertex != edge.to) across.push_back(c.vertex);
    }
  }
  if (across.size() == 2 && across[0] == across[1]) return false;
  std::vector<VertexId> neighbours;
  for_each_corner(edge.from, [&](std::int32_t c) {
    for (const ChartedCorner& other : triangle(c / 3).corners) neighbours.push_back(other.vertex);
  });
  bool good = true;
  for_each_corner(edge.to, [&](std::int32_t c) {
    for (const ChartedCorner& other : triangle(c / 3).corners) {
      const VertexId u = other.vertex;
      if (u == edge.from || u == edge.to) continue;
      const bool common = std::find(neighbours.begin(), neighbours.end(), u) != neighbours.end();
      good = good && (!common || std::find(across.begin(), across.end(), u) != across.end());
    }
  });
  if (!good) return false;
  return std::all_of(across.begin(), across.end(), [&](VertexId u) { return can_lose_a_triangle(u); });
}

/// Vertices keep three edges, two at the surface's end.
bool CollapsibleMesh::can_lose_a_triangle(VertexId v) const {
  int triangles = 0;
  std::vector<VertexId> others;  // each of them twice, but at the surface's end
  for_each_corner(v, [&](std::int32_t c) {
    ++triangles;
    others.push_back(corner(c / 3 * 3 + (c + 1) % 3).vertex);
    others.push_back(corner(c / 3 * 3 + (c + 2) % 3).vertex);
  });
  if (triangles > 3) return true;
  std::sort(others.begin(), others.end());
  others.erase(std::unique(others.begin(), others.end()), others.end());
  const bool is_at_end = static_cast<int>(others.size()) > triangles;
  return is_at_end && triangles > 1;
}

Vec2d CollapsibleMesh::place_after(std::int32_t c, const EdgeCollapse& edge, double share) const {
  const VertexId v = corner(c).vertex;
  for (int k = 0; k < edge.at.count; ++k) {
    const std::int32_t beside = edge.at.triangle[k];
    if (!goes_on_at(v, c / 3, beside)) continue;
    const ChartedTriangle& t = triangle(beside);
    const Vec2d& from = t.corners[corner_with(t, edge.from)].place;
    const Vec2d& to = t.corners[corner_with(t, edge.to)].place;
    if (share == 1) return to;
    return share == 0 ? from : from + (to - from) * share;
  }
  return corner(c).place;  // of a fixed vertex, in a chart that the edge isn't in
}

void CollapsibleMesh::collapse(const EdgeCollapse& edge, const Vec3d& position, double share) {
  // Places first: they are told by the triangles that go.
  std::vector<std::pair<std::int32_t, Vec2d>> places;
  for (const VertexId v : {edge.from, edge.to}) {
    for_each_corner(v, [&](std::int32_t c) {
      if (!edge.at.has(c / 3)) places.emplace_back(c, place_after(c, edge, share));
    });
  }
  for (int k = 0; k < edge.at.count; ++k) alive_[edge.at.triangle[k]] = 0;
  left_ -= edge.at.count;
  for (const auto& [c, place] : places) {
    corner(c).place = place;
    corner(c).vertex = edge.to;
  }
  join_lists(edge.from, edge.to);
  positions_[edge.to] = position;
  if (!surface_.influences.empty() && share == 0) take_influence(edge.from, edge.to);
}

void CollapsibleMesh::take_influence(VertexId from, VertexId to) {
  std::copy_n(&surface_.influences[kWidth * static_cast<std::size_t>(from)], kWidth,
              &surface_.influences[kWidth * static_cast<std::size_t>(to)]);
}

void CollapsibleMesh::join_lists(VertexId from, VertexId to) {
  std::int32_t first = kNone;
  for (const VertexId v : {from, to}) {
    for (std::int32_t c = head_[v]; c != kNone;) {
      const std::int32_t following = next_[c];
      if (alive_[c / 3] != 0) {
        next_[c] = first;
        first = c;
      }
      c = following;
    }
  }
  head_[from] = kNone;
  head_[to] = first;
}

ChartedSurface CollapsibleMesh::surface(std::vector<VertexId>* origins) const {
  std::vector<VertexId> number(positions_.size(), kNone);
  ChartedSurface made;
  for (std::size_t t = 0; t < alive_.size(); ++t) {
    if (alive_[t] == 0) continue;
    ChartedTriangle& left = made.triangles.emplace_back(surface_.triangles[t]);
    for (ChartedCorner& c : left.corners) {
      const auto v = static_cast<std::size_t>(c.vertex);
      if (number[v] == kNone) {
        number[v] = static_cast<VertexId>(made.positions.size());
        if (origins != nullptr) origins->push_back(c.vertex);
        made.positions.push_back(without_negative_zeros(Vec3f(positions_[v])));
        if (!surface_.influences.empty()) {
          const auto first = surface_.influences.begin() + static_cast<std::ptrdiff_t>(kWidth * v);
          made.influences.insert(made.influences.end(), first, first + kWidth);
        }
      }
      c.vertex = number[v];
    }
  }
  return made;
}

}  // namespace lozenge
