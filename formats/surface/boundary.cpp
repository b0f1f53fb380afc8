#include "formats/surface/boundary.h"

#include <algorithm>
#include <bit>
#include <cstdint>

namespace lozenge {

namespace {

using Bits = std::array<std::uint32_t, 3>;

/// \param vertex  the vertex that one is part of
template <typename Vertex>
std::vector<BoundarySide> sides_without_neighbour(std::span<const std::array<VertexId, 3>> triangles, Vertex&& vertex) {
  struct Side {
    VertexId low, high;
    bool forward;
    auto operator<=>(const Side&) const = default;
  };
  std::vector<Side> sides;
  sides.reserve(3 * triangles.size());
  for (const auto& t : triangles) {
    for (int s = 0; s < 3; ++s) {
      const VertexId a = vertex(t[s]);
      const VertexId b = vertex(t[(s + 1) % 3]);
      if (a != b) sides.push_back({std::min(a, b), std::max(a, b), a < b});
    }
  }
  std::sort(sides.begin(), sides.end());
  std::vector<BoundarySide> found;
  for (std::size_t n = 0; n < sides.size(); ++n) {
    const auto same_edge = [&](std::size_t m) {
      return sides[m].low == sides[n].low && sides[m].high == sides[n].high;
    };
    if ((n > 0 && same_edge(n - 1)) || (n + 1 < sides.size() && same_edge(n + 1))) continue;
    found.push_back(sides[n].forward ? BoundarySide{sides[n].low, sides[n].high}
                                     : BoundarySide{sides[n].high, sides[n].low});
  }
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace

std::vector<VertexId> welded_vertices(std::span<const Vec3f> positions) {
  struct Placed {
    Bits bits;
    VertexId vertex;
    auto operator<=>(const Placed&) const = default;
  };
  std::vector<Placed> sorted(positions.size());
  for (std::size_t v = 0; v < sorted.size(); ++v) {
    const Vec3f& p = positions[v];
    sorted[v] = {
        {std::bit_cast<std::uint32_t>(p.x), std::bit_cast<std::uint32_t>(p.y), std::bit_cast<std::uint32_t>(p.z)},
        static_cast<VertexId>(v)};
  }
  std::sort(sorted.begin(), sorted.end());
  std::vector<VertexId> lowest(positions.size());
  for (std::size_t n = 0; n < sorted.size(); ++n) {
    const bool same = n > 0 && sorted[n].bits == sorted[n - 1].bits;
    lowest[sorted[n].vertex] = same ? lowest[sorted[n - 1].vertex] : sorted[n].vertex;
  }
  return lowest;
}

std::vector<std::array<VertexId, 3>> renumbered(std::vector<std::array<VertexId, 3>> triangles,
                                                std::span<const VertexId> vertex) {
  for (auto& corners : triangles) {
    for (VertexId& v : corners) v = vertex[v];
  }
  return triangles;
}

std::vector<BoundarySide> boundary_sides(const SurfaceView& surface) {
  const std::vector<VertexId> vertex = welded_vertices(surface.positions);
  return sides_without_neighbour(surface.triangles, [&](VertexId v) { return vertex[v]; });
}

std::vector<BoundarySide> boundary_sides(std::span<const std::array<VertexId, 3>> triangles) {
  return sides_without_neighbour(triangles, [](VertexId v) { return v; });
}

std::vector<std::vector<VertexId>> boundary_loops(const std::vector<BoundarySide>& sides) {
  std::vector<bool> used(sides.size(), false);
  const auto next_from = [&](VertexId v) {
    auto at = std::lower_bound(sides.begin(), sides.end(), BoundarySide{v, 0});
    while (at != sides.end() && (*at)[0] == v && used[at - sides.begin()]) ++at;
    return at != sides.end() && (*at)[0] == v ? at - sides.begin() : -1;
  };
  std::vector<std::vector<VertexId>> loops;
  for (std::size_t first = 0; first < sides.size(); ++first) {
    if (used[first]) continue;
    std::vector<VertexId> loop;
    for (std::ptrdiff_t n = static_cast<std::ptrdiff_t>(first); n >= 0; n = next_from(sides[n][1])) {
      used[n] = true;
      loop.push_back(sides[n][0]);
      if (sides[n][1] == sides[first][0]) break;
    }
    loops.push_back(std::move(loop));
  }
  return loops;
}

}  // namespace lozenge
