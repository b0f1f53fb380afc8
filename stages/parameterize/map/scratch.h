// Memory that operations on a map use, one after the other: arrays as long as the map's, which would take longer to
// make than most operations do.
#pragma once

#include "stages/parameterize/map/marks.h"

namespace lozenge {

/// Whoever carries operations out has one, and passes it on; of several threads each has its own. What is in it is gone
/// when another function is called with it.
struct Scratch {
  Marks triangles;         ///< [source triangle]
  Marks vertices;          ///< [source vertex]
  Marks domain_triangles;  ///< [domain triangle]
  Numbering places;        ///< [source vertex] its place in a layout
};

}  // namespace lozenge
