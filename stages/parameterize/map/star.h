// The triangles around a domain vertex.
#pragma once

#include <vector>

#include "stages/parameterize/map/working_map.h"

namespace lozenge {

/// Most domain triangles around one vertex. Around a cone of 12 and more, two fans of source triangles could each turn
/// all the way, and then there is no place from which a vertex that is put back there sees its neighbours.
inline constexpr int kMostValence = 10;
/// On the boundary, where a fan that turns by half of a turn or more hides the straight boundary beside it.
inline constexpr int kMostValenceOnBoundary = 5;

/// The domain's corners around a vertex, counter-clockwise; on the boundary from one end of the fan to the other.
std::vector<DomainCorner> star_of(const WorkingMap& map, DomainVertex v);

/// Number of domain triangles around the vertex, and whether it lies on the boundary.
struct Valence {
  int triangles = 0;
  bool on_boundary = false;

  /// How many triangles it lacks (or, negative, has too many) to be flat, on the boundary straight.
  int lack() const { return (on_boundary ? 3 : 6) - triangles; }
  bool is_regular() const { return lack() == 0; }
  int most() const { return on_boundary ? kMostValenceOnBoundary : kMostValence; }
  int least() const { return on_boundary ? 1 : 3; }
};
Valence valence(const WorkingMap& map, DomainVertex v);

}  // namespace lozenge
