// The triangles of a charted surface around each of its vertices, while edges collapse.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "formats/patches/charted_surface.h"

namespace lozenge {

/// The one or two triangles of an edge.
struct EdgeTriangles {
  std::array<std::int32_t, 2> triangle{-1, -1};
  int count = 0;  ///< all of them, where more than two share it

  bool has(std::int32_t t) const { return t == triangle[0] || t == triangle[1]; }
};

/// An edge that goes, with one of its ends.
struct EdgeCollapse {
  VertexId from = -1;  ///< goes
  VertexId to = -1;
  EdgeTriangles at;
};

/// Vertices and triangles keep their numbers. Corners are numbered 3 * triangle + 0..2.
class CollapsibleMesh {
 public:
  explicit CollapsibleMesh(ChartedSurface surface);

  std::size_t vertex_count() const { return positions_.size(); }
  /// Of those that are left.
  std::int64_t triangle_count() const { return left_; }
  /// Those that have gone, too.
  const std::vector<ChartedTriangle>& triangles() const { return surface_.triangles; }
  const ChartedTriangle& triangle(std::int32_t t) const { return surface_.triangles[t]; }
  const ChartedCorner& corner(std::int32_t c) const { return surface_.triangles[c / 3].corners[c % 3]; }
  bool is_left(std::int32_t t) const { return alive_[t] != 0; }
  const std::vector<Vec3d>& positions() const { return positions_; }
  const Vec3d& position(VertexId v) const { return positions_[v]; }
  std::array<Vec3d, 3> corners_of(const ChartedTriangle& t) const;
  /// Elements of `kInfluences`, [vertex]; empty where no body has a skin.
  const std::vector<float>& influences() const { return surface_.influences; }

  /// `visit(corner)` for each triangle of a vertex.
  template <typename Visit>
  void for_each_corner(VertexId v, Visit visit) const {
    for (std::int32_t c = head_[v]; c != -1; c = next_[c]) {
      if (alive_[c / 3] != 0) visit(c);
    }
  }

  /// `visit(a, b, triangles)` for each edge once.
  template <typename Visit>
  void for_each_edge(Visit visit) const {
    for (std::size_t t = 0; t < alive_.size(); ++t) {
      if (alive_[t] == 0) continue;
      for (int k = 0; k < 3; ++k) {
        const VertexId a = surface_.triangles[t].corners[k].vertex;
        const VertexId b = surface_.triangles[t].corners[(k + 1) % 3].vertex;
        const EdgeTriangles at = triangles_at(a, b);
        if (at.triangle[0] == static_cast<std::int32_t>(t)) visit(a, b, at);
      }
    }
  }

  EdgeTriangles triangles_at(VertexId a, VertexId b) const;
  /// Sorted.
  std::vector<VertexId> neighbours(VertexId v) const;

  /// Whether an edge is of a line that must stay: the surface's end, or where charts or groups meet.
  bool is_line(VertexId a, VertexId b, const EdgeTriangles& at) const;
  /// Whether its line is one that has a shape, not only a border of patches.
  bool is_feature(const EdgeTriangles& at) const;

  /// Whether the surface stays what it is: the two have no neighbours in common but those across from their edge (the
  /// link condition), and what is left is no double triangle.
  bool keeps_topology(const EdgeCollapse& edge) const;

  /// The place that the vertex left over has in the chart of a triangle that stays: that of the edge's own triangle
  /// there. \param c  the corner of one of the edge's ends \param share  of the way from one end to the other
  Vec2d place_after(std::int32_t c, const EdgeCollapse& edge, double share) const;

  /// What is left over takes on the influences of the end that it is nearer to.
  void collapse(const EdgeCollapse& edge, const Vec3d& position, double share);

  /// What is left; what corners carry and the planes of triangles are no longer right.
  /// \param origins  unless null: gets the number that each vertex had
  ChartedSurface surface(std::vector<VertexId>* origins) const;

 private:
  ChartedCorner& corner(std::int32_t c) { return surface_.triangles[c / 3].corners[c % 3]; }
  bool goes_on_at(VertexId v, std::int32_t s, std::int32_t t) const;
  bool can_lose_a_triangle(VertexId v) const;
  void take_influence(VertexId from, VertexId to);
  void join_lists(VertexId from, VertexId to);

  ChartedSurface surface_;
  std::vector<Vec3d> positions_;
  std::vector<std::int32_t> head_;  ///< [vertex] first corner of its list
  std::vector<std::int32_t> next_;  ///< [corner]
  std::vector<std::uint8_t> alive_;
  std::int64_t left_;
};

/// As long as twice the triangle's area.
inline Vec3d cross_of(const std::array<Vec3d, 3>& p) { return (p[1] - p[0]).cross(p[2] - p[0]); }

}  // namespace lozenge
