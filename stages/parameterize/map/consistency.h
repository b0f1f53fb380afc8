// Whether the charts tell a map at all: the same on both sides of every edge, and of the domain as it is.
#pragma once

#include "stages/parameterize/map/working_map.h"

namespace lozenge {

/// The charts of a triangle and of the triangles beside it tell the same of the edges that they share.
bool is_consistent(const WorkingMap& map, TriangleId t);

/// A triangle's charts are those of the straight lines between its corners, as the domain is.
bool agrees_with_domain(const WorkingMap& map, TriangleId t);

/// All triangles around the vertex have images of positive area that agree with their neighbours'.
bool is_sound(const WorkingMap& map, VertexId v);

}  // namespace lozenge
