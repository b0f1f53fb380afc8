// The surface around a domain vertex, laid out in the polygon of a star domain (paper, Sec. 4.1).
#pragma once

#include <cstddef>
#include <vector>

#include "stages/parameterize/map/surroundings.h"
#include "stages/parameterize/map/working_map.h"
#include "stages/parameterize/relax/star_polygon.h"

namespace lozenge {

/// Source vertices laid out in a star's polygon.
struct StarLayout {
  std::vector<VertexId> vertices;  ///< unpinned, or pinned to the star's centre; no vertex of the rim
  std::vector<Vec2d> at;

  void add(VertexId v, const Vec2d& p) {
    vertices.push_back(v);
    at.push_back(p);
  }
};

/// Whether the vertex at a place of the layout may become the star's centre: on the boundary, one that lies there.
bool may_be_centre(const WorkingMap& map, const StarPolygon& polygon, const StarLayout& layout, std::size_t place);

/// Places in the layout of the vertices that are nearest to a point and may become the centre, nearest first; at most
/// `most` of them.
std::vector<std::size_t> nearest_in_layout(const WorkingMap& map, const StarPolygon& polygon, const StarLayout& layout,
                                           const Vec2d& p, std::size_t most);

/// The polygon of a star.
StarPolygon polygon_of(const WorkingMap& map, const std::vector<DomainCorner>& star);

/// Lays out what is at home in a star by the inverse of g_E.
StarLayout lay_out_star(const WorkingMap& map, const std::vector<DomainCorner>& star, StarShape shape);

/// The star as a region: what is laid out moves.
Region region_of(const WorkingMap& map, const std::vector<DomainCorner>& star, const StarLayout& layout);

}  // namespace lozenge
