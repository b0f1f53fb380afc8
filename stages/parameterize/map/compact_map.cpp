// Vertices are sorted by their home and, in it, by a curve through its frame; triangles by their first corner. Most of
// the time goes into the copying, so each array is filled by all threads.
#include "stages/parameterize/map/compact_map.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <utility>

#include "formats/base/parallel.h"
#include "stages/parameterize/map/curve_order.h"
#include "stages/parameterize/map/homes.h"

namespace lozenge {

namespace {

/// Along the domain's triangles, and in each along a curve.
std::uint64_t place_of(DomainTriangleId home, const Vec2d& at) {
  const auto cell = [](double x) { return static_cast<std::uint32_t>(std::clamp(x, 0.0, 1.0) * 65535.0); };
  return (static_cast<std::uint64_t>(home) << 32) | interleaved<2>({cell(at.x), cell(at.y)});
}

std::vector<VertexId> vertices_along_curves(const WorkingMap& whole) {
  std::vector<std::pair<std::uint64_t, VertexId>> keys;
  keys.reserve(whole.home.size());
  for (VertexId v = 0; v < whole.mesh.vertex_count(); ++v) {
    if (whole.home[v] >= 0) keys.emplace_back(0, v);
  }
  for_each_part(keys.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      auto& [place, v] = keys[i];
      place = place_of(whole.home[v], whole.at[v]);
    }
  });
  return numbers_by_key(std::move(keys));
}

/// By the first of their corners. \param number  [vertex]
std::vector<TriangleId> triangles_along_vertices(const HalfedgeMesh& mesh, const std::vector<VertexId>& number) {
  std::vector<std::pair<VertexId, TriangleId>> keys;
  keys.reserve(mesh.triangles.size());
  for (TriangleId t = 0; t < mesh.triangle_count(); ++t) {
    if (!mesh.removed(t)) keys.emplace_back(0, t);
  }
  for_each_part(keys.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto& [a, b, c] = mesh.triangles[keys[i].second];
      keys[i].first = std::min({number[a], number[b], number[c]});
    }
  });
  return numbers_by_key(std::move(keys));
}

/// [old number] new one; -1 where it has none
std::vector<std::int32_t> inverse_of(const std::vector<std::int32_t>& old_numbers, std::size_t size) {
  std::vector<std::int32_t> number(size, -1);
  for_each_part(old_numbers.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) number[old_numbers[i]] = static_cast<std::int32_t>(i);
  });
  return number;
}

/// Makes room, each array on a thread: most of the time goes into fresh memory.
template <typename... Vectors>
void resize_all(std::size_t size, Vectors&... vectors) {
  const std::array<std::function<void()>, sizeof...(vectors)> resize{[&vectors, size] { vectors.resize(size); }...};
  for_each_index(resize.size(), true, [&](std::size_t i) { resize[i](); });
}

}  // namespace

CompactMap::CompactMap(const WorkingMap& whole) : vertices_(vertices_along_curves(whole)) {
  const std::vector<VertexId> number = inverse_of(vertices_, whole.home.size());
  triangles_ = triangles_along_vertices(whole.mesh, number);
  const std::vector<TriangleId> triangle_number = inverse_of(triangles_, whole.mesh.triangles.size());
  const auto halfedge = [&](Halfedge h) { return h < 0 ? h : 3 * triangle_number[h / 3] + h % 3; };

  map_.settings() = whole.settings();
  map_.abstract_domain() = whole.abstract_domain();
  for (VertexId& v : map_.anchor) {
    if (v >= 0) v = number[v];
  }

  map_.surface_area = whole.surface_area;
  map_.is_compact = true;
  map_.listed = false;
  resize_all(vertices_.size(), map_.mesh.outgoing, map_.home, map_.at, map_.pin);
  for_each_part(vertices_.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const VertexId v = vertices_[i];
      map_.mesh.outgoing[i] = halfedge(whole.mesh.outgoing[v]);
      map_.take_vertex(static_cast<VertexId>(i), whole, v);
    }
  });
  resize_all(triangles_.size(), map_.mesh.triangles, map_.rest);
  resize_all(3 * triangles_.size(), map_.mesh.twins, map_.chart);
  for_each_part(triangles_.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const TriangleId t = triangles_[i];
      map_.rest[i] = whole.rest[t];
      for (int c = 0; c < 3; ++c) {
        map_.mesh.triangles[i][c] = number[whole.mesh.triangles[t][c]];
        map_.mesh.twins[3 * i + c] = halfedge(whole.mesh.twins[3 * t + c]);
      }
      map_.take_triangle(static_cast<TriangleId>(i), whole, t);
    }
  });
}

void CompactMap::write_back(WorkingMap& whole) const {
  for_each_part(vertices_.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      whole.take_vertex(vertices_[i], map_, static_cast<VertexId>(i));
    }
  });
  for_each_part(triangles_.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      whole.take_triangle(triangles_[i], map_, static_cast<TriangleId>(i));
    }
  });
  for (std::size_t n = 0; n < map_.anchor.size(); ++n) {
    whole.anchor[n] = map_.anchor[n] < 0 ? -1 : vertices_[map_.anchor[n]];
  }
  if (whole.listed) list_homes(whole);
}

}  // namespace lozenge
