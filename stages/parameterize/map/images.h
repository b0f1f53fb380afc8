// What the charts say: where the corners of source triangles lie, flat, and how the frames of triangles side by side
// hang together.
#pragma once

#include <array>
#include <vector>

#include "stages/parameterize/map/marks.h"
#include "stages/parameterize/map/working_map.h"

namespace lozenge {

/// The image of a triangle's corner, in the triangle's frame.
inline Vec2d image_of_corner(const WorkingMap& map, TriangleId t, int corner) {
  return map.chart[3 * t + corner](map.at[map.mesh.triangles[t][corner]]);
}

/// A source triangle's corners, flat, in the triangle's frame.
using FlatImage = std::array<Vec2d, 3>;
inline FlatImage flat_image(const WorkingMap& map, TriangleId t) {
  return {image_of_corner(map, t, 0), image_of_corner(map, t, 1), image_of_corner(map, t, 2)};
}

inline double doubled_area(const FlatImage& p) { return cross(p[1] - p[0], p[2] - p[0]); }
/// Twice the area of the image.
inline double doubled_image_area(const WorkingMap& map, TriangleId t) { return doubled_area(flat_image(map, t)); }

/// From the frame of the triangle of half-edge h into the frame of its twin's triangle.
UnitMotion motion_across(const WorkingMap& map, Halfedge h);

/// The neighbours of a vertex, counter-clockwise, in the frame of its home. Triangle i lies between neighbours i and
/// i + 1; of a vertex on the boundary there is one neighbour more than triangles.
struct Ring {
  std::vector<Vec2d> at;
  std::vector<Halfedge> halfedges;  ///< from the centre to neighbour i, in triangle i
};

/// \pre the vertex is not pinned
void gather_ring(const WorkingMap& map, VertexId v, Ring& ring);

/// The triangles around the vertices, each once.
void triangles_around(const WorkingMap& map, const std::vector<VertexId>& vertices, Marks& marks,
                      std::vector<TriangleId>& triangles);

}  // namespace lozenge
