// Laying the surface around a domain vertex out in a star domain, and back with another centre (paper, Sec. 5.3
// and 5.6).
//
// Collapses, and the optimization of irregular stars, work alike: all source vertices of some domain triangles get
// positions in a convex polygon E, the star domain of one vertex n; then a new centre is chosen in E, each slice
// between the centre and a side of the polygon is mapped linearly onto one domain triangle, folds are healed and the
// map is relaxed. The source vertex at the new centre is pinned to n where n is a cone.
#pragma once

#include "stages/parameterize/map/local_change.h"
#include "stages/parameterize/relax/local_optimization.h"
#include "stages/parameterize/relax/star_layout.h"

namespace lozenge {

/// Maps every vertex of the layout into the star of `n`, with its centre at the layout's point `centre`; pins
/// `anchor` to n where it is not -1. Heals and relaxes. \param change  opened for the layout
/// \return false where folds remain; the map is then changed, and the caller takes that back
bool embed_star(LocalChange& change, DomainVertex n, const StarLayout& layout, const Vec2d& centre, VertexId anchor,
                const RelaxOptions& options);

}  // namespace lozenge
