// The source vertex that becomes the centre of the star which a collapse makes (paper, Sec. 5.3).
#pragma once

#include <cstddef>
#include <vector>

#include "stages/parameterize/map/marks.h"
#include "stages/parameterize/map/path_lengths.h"
#include "stages/parameterize/map/working_map.h"
#include "stages/parameterize/relax/star_layout.h"

namespace lozenge {

/// Places in the layout of vertices that may become the centre, the most promising first. \param embedded  where the
/// new vertex lies in space, as long as the measures are warming up \param places  is filled with the layout's
std::vector<std::size_t> rank_centres(const WorkingMap& map, const SurfaceMeasures& measures, const StarLayout& layout,
                                      const StarPolygon& polygon, const Vec3d& embedded, Numbering& places);

}  // namespace lozenge
