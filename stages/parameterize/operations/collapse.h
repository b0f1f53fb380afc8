// Edge collapses on the abstract domain (paper, Sec. 5.3).
#pragma once

#include "stages/parameterize/map/checkpoint.h"
#include "stages/parameterize/map/path_lengths.h"
#include "stages/parameterize/map/working_map.h"
#include "stages/parameterize/relax/local_optimization.h"

namespace lozenge {

/// The collapse leaves a manifold of the same topology: the link condition, and no vertex with fewer than 3 triangles
/// or more than kMostValence.
bool can_collapse(const WorkingMap& map, DomainSide side);

/// The end of the side that the collapse leaves: its start, or its end where that is one of the user's cones.
DomainVertex surviving_vertex(const WorkingMap& map, DomainSide side);

/// Cost of collapsing a side (paper, eq. 2): the areas of the two regions that vanish, and the square of the path's
/// length. In squared units of the source mesh; the least is collapsed first.
double collapse_cost(const WorkingMap& map, const SurfaceMeasures& measures, DomainSide side);

struct CollapseOptions {
  RelaxOptions relax{5, 1e-2};
  /// Also pin a source vertex to the new vertex where it is regular: wanted while domain triangles hold so few vertices
  /// that two unpinned ones may lie in corners.
  bool pin_regular = true;
};

/// Collapses the side into one vertex, the `surviving_vertex`, and carries the map along through
/// the star domain of the new vertex: the images of the two ends and of the new centre are placed in it so that the
/// distortion is small, then the map is relaxed over it. \pre can_collapse \return false, with nothing changed, where
/// every centre that was tried leaves a fold
bool collapse(WorkingMap& map, SurfaceMeasures& measures, DomainSide side, const CollapseOptions& options);

/// The same, with the way back in `undo` (the new vertex's embedding in `measures` apart), and what it costs in `rise`:
/// by how much the energy around is higher than it was, both with the scale that belongs to the smaller domain.
bool collapse(WorkingMap& map, SurfaceMeasures& measures, DomainSide side, const CollapseOptions& options,
              Checkpoint& undo, double& rise);

}  // namespace lozenge
