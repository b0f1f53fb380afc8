// The triangles around a vertex of a charted surface, in their order.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "formats/patches/charted_surface.h"

namespace lozenge {

/// Which triangles each vertex has, kept as they change.
class TrianglesAround {
 public:
  explicit TrianglesAround(const ChartedSurface& surface);

  std::span<const std::int32_t> operator[](VertexId v) const;
  void replace(VertexId v, std::vector<std::int32_t> triangles);

 private:
  std::vector<std::int32_t> first_;  ///< [vertex] of its triangles in `all_`
  std::vector<std::int32_t> all_;
  std::vector<std::int32_t> changed_;  ///< [vertex] its list in `lists_`, or -1
  std::vector<std::vector<std::int32_t>> lists_;
};

/// The corner of a triangle that has this vertex.
inline int corner_with(const ChartedTriangle& triangle, VertexId v) {
  return triangle.corners[0].vertex == v ? 0 : triangle.corners[1].vertex == v ? 1 : 2;
}

/// Triangle j lies between rim[j] and rim[j + 1], counter-clockwise around the vertex.
struct VertexFan {
  VertexId vertex = -1;
  std::vector<VertexId> rim;
  std::vector<std::int32_t> triangles;
  std::vector<int> corner;  ///< [triangle] the vertex's
  bool closed = true;       ///< the last triangle ends at rim[0]; else the surface ends here

  int size() const { return static_cast<int>(triangles.size()); }
  VertexId end_of(int j) const { return rim[static_cast<std::size_t>(j + 1) % rim.size()]; }
};

/// Nothing where the triangles form no single fan, or more than are worth the trouble.
std::optional<VertexFan> fan_of(const ChartedSurface& surface, const TrianglesAround& around, VertexId v);

}  // namespace lozenge
