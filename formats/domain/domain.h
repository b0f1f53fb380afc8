// The abstract domain D (paper, Sec. 4): equilateral triangles of unit side, known by their adjacency alone.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace lozenge {

using DomainVertex = std::int32_t;
using DomainTriangleId = std::int32_t;

/// A side of a domain triangle. Side s runs from corner s to corner (s + 1) % 3, counter-clockwise; the corner
/// opposite is (s + 2) % 3. As a half-edge it belongs to the triangle on its left.
struct DomainSide {
  DomainTriangleId triangle = -1;
  std::int32_t side = -1;

  bool exists() const { return triangle >= 0; }
  friend bool operator==(const DomainSide&, const DomainSide&) = default;
};

struct DomainTriangle {
  std::array<DomainVertex, 3> corners{-1, -1, -1};
  /// [side] the side of the neighbour that coincides with it, or none where the surface ends.
  std::array<DomainSide, 3> neighbours{};
};

/// One corner of one domain triangle.
struct DomainCorner {
  DomainTriangleId triangle = -1;
  std::int32_t corner = -1;
  friend bool operator==(const DomainCorner&, const DomainCorner&) = default;
};

/// The abstract domain: a consistently oriented 2-manifold of triangles.
struct Domain {
  std::vector<DomainTriangle> triangles;
  DomainVertex vertex_count = 0;

  std::int32_t size() const { return static_cast<std::int32_t>(triangles.size()); }
  DomainSide neighbour(DomainSide s) const { return triangles[s.triangle].neighbours[s.side]; }
  DomainVertex corner(DomainTriangleId t, int c) const { return triangles[t].corners[c]; }
  DomainVertex start(DomainSide s) const { return triangles[s.triangle].corners[s.side]; }
  DomainVertex end(DomainSide s) const { return triangles[s.triangle].corners[(s.side + 1) % 3]; }
};

/// A domain with these corners, counter-clockwise, whose sides are joined wherever two run between the same two corners
/// in opposite directions. Vertices keep their numbers; there are `vertex_count` of them. \throws Error(kUnsupported)
/// where three or more sides share an edge or two sides run in the same direction
Domain make_domain(const std::vector<std::array<DomainVertex, 3>>& corners, DomainVertex vertex_count);

/// What breaks the structure of `domain`, in words that name the place, or nothing where it is sound: adjacency is
/// reciprocal and agrees with the corners, every vertex is used, and its triangles form one fan.
std::optional<std::string> find_defect(const Domain& domain);

/// One corner for each vertex, [vertex]: where the vertex lies on the boundary, the first of its fan, so that turning
/// counter-clockwise from it visits all.
std::vector<DomainCorner> corner_of_each_vertex(const Domain& domain);

/// The corners around the vertex of `first`, counter-clockwise, starting there. Of a boundary vertex, those up to the
/// end of its fan.
std::vector<DomainCorner> corners_around(const Domain& domain, DomainCorner first);

/// The next corner counter-clockwise around the same vertex, or triangle -1 at the end of a boundary fan.
DomainCorner next_around(const Domain& domain, DomainCorner c);
/// The one before it, clockwise, or triangle -1 at the start of a boundary fan.
DomainCorner previous_around(const Domain& domain, DomainCorner c);

/// [vertex] the number of triangles that share it.
std::vector<std::int32_t> valences(const Domain& domain);

/// Every edge once, as its side of the lower (triangle, side); ascending. Patches are numbered in this order.
std::vector<DomainSide> edges(const Domain& domain);

/// Vertices - edges + triangles.
std::int32_t euler_characteristic(const Domain& domain);

/// Interior vertices of a valence other than 6 (boundary vertices: other than 3): the cones of the flat metric.
std::int32_t count_irregular(const Domain& domain);

}  // namespace lozenge
