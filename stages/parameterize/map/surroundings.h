// How the map hangs together across the rim of a region of the domain, so that the region can be laid out anew.
//
// A collapse, a flip or a crawling cone gives the vertices inside a few domain triangles new homes and positions, and
// leaves everything outside, and the region's rim, as it is. A source triangle that reaches over the rim passes through
// a gate: a place on the rim, and the motion from the frame outside of it into the source triangle's own. Whatever the
// region looks like afterwards, the charts of the corners inside are found by going from their new homes to the gate.
#pragma once

#include <optional>
#include <vector>

#include "stages/parameterize/map/scratch.h"
#include "stages/parameterize/map/working_map.h"

namespace lozenge {

struct Gate {
  DomainSide outer;  ///< side on the rim, of the domain triangle outside; triangle -1: none is needed
  double share = 0;  ///< how far along that side
  UnitMotion chart;  ///< from the outer triangle's frame into the source triangle's
};

/// A source triangle with a corner that moves, and how it hangs on to what stays. Without a gate, all its corners move
/// or are pinned to the rim, and its image lies inside of the region.
struct MovingTriangle {
  TriangleId triangle = -1;
  Gate gate;

  bool is_inside() const { return gate.outer.triangle < 0; }
};

/// The region: its domain triangles, the vertices that will move (free ones at home there, and those pinned to its
/// inner domain vertices), and the domain vertices on its rim.
struct Region {
  std::vector<DomainTriangleId> triangles;
  std::vector<VertexId> moving;
  std::vector<DomainVertex> rim;
};

/// How the source triangles with a corner that moves hang on to the rest.
/// \param triangles  all of them (`triangles_around` what moves)
/// \return nothing where the charts don't tell that of one of them: it has too many pinned corners
std::optional<std::vector<MovingTriangle>> find_surroundings(const WorkingMap& map, const Region& region,
                                                             const std::vector<TriangleId>& triangles,
                                                             Scratch& scratch);

/// From the frame of the domain triangle just inside of the gate, as the domain is now, into the source triangle's.
inline UnitMotion chart_inside(const WorkingMap& map, const Gate& gate) {
  return composed(gate.chart, unit_transition(gate.outer.side, map.domain.neighbour(gate.outer).side));
}

/// The domain triangles around are as the charts say: every triangle agrees with its neighbours.
bool are_consistent(const WorkingMap& map, const std::vector<MovingTriangle>& moving);

}  // namespace lozenge
