// The surface around a side that collapses, laid out in the polygon of the star that is made (paper, Sec. 5.3).
#pragma once

#include "stages/parameterize/map/energy.h"
#include "stages/parameterize/map/surroundings.h"
#include "stages/parameterize/map/working_map.h"
#include "stages/parameterize/operations/fans.h"
#include "stages/parameterize/relax/star_layout.h"

namespace lozenge {

/// Where the ends of the collapsed side lie in the new star's polygon.
struct StarEnds {
  Vec2d a, b;
};

/// Places both ends so that the isometric distortion of all affected domain triangles in the polygon is least: Newton
/// steps on one and the other in turn, along the diameter where the end lies on the boundary.
StarEnds place_ends(const Energy& energy, const Fans& fans);

/// Every source vertex that the collapse moves, laid out in the polygon.
StarLayout lay_out_fans(const WorkingMap& map, const Fans& fans, const StarEnds& ends);

/// The fans as a region: what is laid out moves.
Region region_of(const WorkingMap& map, const Fans& fans, const StarLayout& layout);

}  // namespace lozenge
