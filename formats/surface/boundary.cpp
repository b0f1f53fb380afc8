#include "formats/surface/boundary.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <numeric>

#include "formats/base/parallel.h"

namespace lozenge {

namespace {

using Bits = std::array<std::uint32_t, 3>;

/// The sides of triangles, each in the list of its lower vertex; so those of an edge are in one list, and a surface of
/// millions of triangles needs no sorting as a whole.
class SidesByVertex {
 public:
  /// \param vertex  the vertex that one is part of
  template <typename Vertex>
  SidesByVertex(std::span<const std::array<VertexId, 3>> triangles, const Vertex& vertex) {
    VertexId last = -1;
    for (const auto& t : triangles) {
      for (const VertexId v : t) last = std::max(last, vertex(v));
    }
    first_.assign(static_cast<std::size_t>(last) + 2, 0);
    for_each_side(triangles, vertex, [&](VertexId low, Side) { ++first_[static_cast<std::size_t>(low) + 1]; });
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    sides_.resize(first_.back());
    std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
    for_each_side(triangles, vertex, [&](VertexId low, Side side) { sides_[next[low]++] = side; });
    for_each_part(vertices(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v) std::sort(sides_.data() + first_[v], sides_.data() + first_[v + 1]);
    });
  }

  /// Of edges that a single triangle has, ascending.
  std::vector<BoundarySide> without_neighbour() const {
    std::vector<BoundarySide> found;
    for (std::size_t v = 0; v < vertices(); ++v) {
      const std::span<const Side> sides = of(v);
      for (std::size_t n = 0; n < sides.size(); ++n) {
        const auto same_edge = [&](std::size_t m) { return high(sides[m]) == high(sides[n]); };
        if ((n > 0 && same_edge(n - 1)) || (n + 1 < sides.size() && same_edge(n + 1))) continue;
        const auto low = static_cast<VertexId>(v);
        found.push_back(is_forward(sides[n]) ? BoundarySide{low, high(sides[n])} : BoundarySide{high(sides[n]), low});
      }
    }
    std::sort(found.begin(), found.end());
    return found;
  }

  bool has_repeated() const {
    for (std::size_t v = 0; v < vertices(); ++v) {
      const std::span<const Side> sides = of(v);
      if (std::adjacent_find(sides.begin(), sides.end()) != sides.end()) return true;
    }
    return false;
  }

 private:
  /// The higher vertex, and in the lowest bit whether it is the side's end.
  using Side = std::uint32_t;
  static VertexId high(Side side) { return static_cast<VertexId>(side >> 1); }
  static bool is_forward(Side side) { return (side & 1) != 0; }

  template <typename Vertex, typename Visit>
  static void for_each_side(std::span<const std::array<VertexId, 3>> triangles, const Vertex& vertex,
                            const Visit& visit) {
    for (const auto& t : triangles) {
      const std::array<VertexId, 3> corners{vertex(t[0]), vertex(t[1]), vertex(t[2])};
      for (int s = 0; s < 3; ++s) {
        const VertexId a = corners[s];
        const VertexId b = corners[(s + 1) % 3];
        if (a != b) visit(std::min(a, b), 2 * static_cast<Side>(std::max(a, b)) + (a < b ? 1 : 0));
      }
    }
  }

  std::size_t vertices() const { return first_.size() - 1; }
  std::span<const Side> of(std::size_t v) const { return {sides_.data() + first_[v], sides_.data() + first_[v + 1]}; }

  std::vector<std::size_t> first_;  ///< [vertex] into sides_; one more at the end
  std::vector<Side> sides_;         ///< ascending in each list
};

VertexId itself(VertexId v) { return v; }

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
  return SidesByVertex(surface.triangles, [&](VertexId v) { return vertex[v]; }).without_neighbour();
}

std::vector<BoundarySide> boundary_sides(std::span<const std::array<VertexId, 3>> triangles) {
  return SidesByVertex(triangles, itself).without_neighbour();
}

bool has_repeated_sides(std::span<const std::array<VertexId, 3>> triangles) {
  return SidesByVertex(triangles, itself).has_repeated();
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
