// Where vertices are at home, and the lists of those at home in each domain triangle.
#pragma once

#include <vector>

#include "stages/parameterize/map/working_map.h"

namespace lozenge {

/// Makes the lists anew, for a map whose vertices moved while `listed` was off.
void list_homes(WorkingMap& map);

/// Every vertex, those of a domain triangle together.
std::vector<VertexId> vertices_by_triangle(const WorkingMap& map);

/// Puts a vertex into a home's list and at a point of it; its charts are the caller's.
void set_home(WorkingMap& map, VertexId v, DomainTriangleId home, const Vec2d& at);
/// Moves a vertex to another home, whose frame `back` takes into that of the old one, and its charts along.
void move_home(WorkingMap& map, VertexId v, DomainTriangleId home, const Vec2d& at, const UnitMotion& back);

}  // namespace lozenge
