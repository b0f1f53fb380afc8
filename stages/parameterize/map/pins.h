// Vertices pinned to domain vertices: at every cone one lies, so that no source triangle has a cone inside.
#pragma once

#include "stages/parameterize/map/working_map.h"

namespace lozenge {

/// Pins a vertex to a domain vertex (which must have no anchor); its charts are the caller's.
void pin_to(WorkingMap& map, VertexId v, DomainVertex corner);
void unpin(WorkingMap& map, VertexId v);
/// Gives a pinned vertex the corner that `corner_of` names now, its image unchanged.
void renew_pin(WorkingMap& map, VertexId v);
/// Lets go of a vertex that is pinned to a regular domain vertex, and finds its charts.
/// \return false, with nothing changed, where too much around it is pinned for that
bool free_regular_vertex(WorkingMap& map, VertexId v);

/// The corner of its home that a pinned vertex lies in.
int corner_of_pinned(const WorkingMap& map, VertexId v);

/// The chart of a vertex pinned to a domain triangle's corner, whose image lies at `step` of a triangle's frame.
inline UnitMotion chart_of_pinned(int corner, UnitPoint step) { return {0, step - corner_step(corner)}; }

/// Two images of one point differ by rounding alone.
inline constexpr double kSamePoint = 1e-9;

/// The corner of triangle `home` that lies at a point and belongs to a domain vertex, or -1.
int corner_there(const Domain& domain, DomainTriangleId home, const Vec2d& at, DomainVertex n);

}  // namespace lozenge
