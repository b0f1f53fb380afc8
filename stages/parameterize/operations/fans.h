// The two fans of domain triangles that a collapse makes one star of.
#pragma once

#include <cstddef>
#include <vector>

#include "stages/parameterize/map/working_map.h"
#include "stages/parameterize/relax/star_polygon.h"

namespace lozenge {

/// One triangle of the star that is made: the corner that will be the star's, and which end it belongs to now.
struct Slice {
  DomainCorner corner;
  bool of_a = false;
};

/// The two fans that become one star. Slices are numbered counter-clockwise around it. Corner m of the rim starts slice
/// m; inside of the surface the first one lies opposite the side in its own triangle, and slice by slice a's fan comes
/// first, then b's. On the boundary the star starts where the boundary leaves it.
struct Fans {
  DomainVertex a, b;
  DomainVertex kept, gone;  ///< of the two
  DomainSide side, across;  ///< the triangles that vanish; `across` doesn't exist on the boundary
  std::vector<Slice> slices;
  bool on_boundary = false;
  bool a_on_boundary = false, b_on_boundary = false;
  /// The corners of the rim that an end shares with the other one, counter-clockwise behind its own slices and before
  /// them; -1 beyond the boundary. Those before a and behind b are the one opposite the side in its own triangle.
  struct Shared {
    int before = -1;
    int behind = -1;
  };
  Shared shared_of_a, shared_of_b;

  int count() const { return static_cast<int>(slices.size()); }
  StarPolygon polygon() const { return {count(), on_boundary}; }
  void add(const std::vector<DomainCorner>& corners, std::size_t begin, std::size_t end, bool of_a) {
    for (std::size_t i = begin; i < end; ++i) slices.push_back({corners[i], of_a});
  }
};

Fans find_fans(const WorkingMap& map, DomainSide side);

/// The end of a side that a collapse leaves: `a`, or `b` where that is one of the user's cones.
DomainVertex surviving_end(const WorkingMap& map, DomainVertex a, DomainVertex b);

/// How many slices an end has.
int count_slices(const Fans& fans, bool of_a);

/// The domain triangles that vanish.
std::vector<DomainTriangleId> vanishing(const Fans& fans);

}  // namespace lozenge
