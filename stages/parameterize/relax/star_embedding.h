// Laying the surface around a domain vertex out in a star domain, and back with another centre (paper, Sec. 5.3
// and 5.6).
//
// Collapses, and the optimization of irregular stars, work alike: all source vertices of some domain triangles get
// positions in a convex polygon E, the star domain of one vertex n; then a new centre is chosen in E, each slice
// between the centre and a side of the polygon is mapped linearly onto one domain triangle, folds are healed and the
// map is relaxed. The source vertex at the new centre is pinned to n where n is a cone.
#pragma once

#include <optional>
#include <vector>

#include "stages/parameterize/map/checkpoint.h"
#include "stages/parameterize/map/surroundings.h"
#include "stages/parameterize/map/working_map.h"
#include "stages/parameterize/relax/local_optimization.h"
#include "stages/parameterize/relax/star_polygon.h"

namespace lozenge {

/// Source vertices laid out in a star's polygon.
struct StarLayout {
  std::vector<VertexId> vertices;  ///< unpinned, or pinned to the star's centre; no vertex of the rim
  std::vector<Vec2d> at;
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

/// Maps every vertex of the layout into the star of `n`, with its centre at the layout's point `centre`; pins
/// `anchor` to n where it is not -1. Heals and relaxes. The triangles that hang on the layout were found before.
/// \return false where folds remain; the map is then changed, and the caller restores it
bool embed_star(WorkingMap& map, DomainVertex n, const StarLayout& layout, const std::vector<Hanging>& hanging,
                const Vec2d& centre, VertexId anchor, const RelaxOptions& options);

/// The star as a region: what is laid out moves.
Region region_of(const WorkingMap& map, const std::vector<DomainCorner>& star, const StarLayout& layout);

/// Keeps all that `embed_star` changes.
void keep_layout(Checkpoint& checkpoint, DomainVertex n, const StarLayout& layout, const std::vector<Hanging>& hanging);

/// Makes sure that a source vertex is pinned to `n`: the nearest is drawn to it.
/// \return false, with the map unchanged, where that can't be done without folds
bool ensure_anchor(WorkingMap& map, DomainVertex n);

}  // namespace lozenge
