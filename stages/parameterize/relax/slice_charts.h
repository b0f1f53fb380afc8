// The charts of the source triangles in a star that was laid out anew.
#pragma once

#include <vector>

#include "stages/parameterize/map/marks.h"
#include "stages/parameterize/map/surroundings.h"
#include "stages/parameterize/map/working_map.h"
#include "stages/parameterize/relax/star_layout.h"

namespace lozenge {

/// Gives the triangles around a layout their charts. \param slices  [place in the layout] the slice that the vertex
/// lies in \param centre  where the slices meet, in the layout \param anchor  the vertex pinned there, or -1
/// \param places  is filled with the layout's
void make_star_charts(WorkingMap& map, const std::vector<DomainCorner>& star, const StarLayout& layout,
                      const std::vector<int>& slices, const std::vector<MovingTriangle>& surroundings,
                      const Vec2d& centre, VertexId anchor, Numbering& places);

}  // namespace lozenge
