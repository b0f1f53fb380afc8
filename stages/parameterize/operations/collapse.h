// Edge collapses on the abstract domain (paper, Sec. 5.3).
#pragma once

#include <optional>

#include "stages/parameterize/map/local_change.h"
#include "stages/parameterize/map/path_lengths.h"
#include "stages/parameterize/map/working_map.h"
#include "stages/parameterize/relax/local_optimization.h"

namespace lozenge {

/// The end of the side that the collapse leaves: its start, or its end where that is one of the user's cones.
DomainVertex surviving_vertex(const WorkingMap& map, DomainSide side);

/// Cost of collapsing a side (paper, eq. 2): the areas of the two regions that vanish, and the square of the path's
/// length. In squared units of the source mesh; the least is collapsed first.
double collapse_cost(const WorkingMap& map, const SurfaceMeasures& measures, DomainSide side);

struct CollapseOptions {
  RelaxOptions relax = kRelaxAround;
  /// Also pin a source vertex to the new vertex where it is regular: wanted while domain triangles hold so few vertices
  /// that two unpinned ones may lie in corners.
  bool pin_regular = true;
};

/// Collapses the side into one vertex, the `surviving_vertex`, and carries the map along through
/// the star domain of the new vertex: the images of the two ends and of the new centre are placed in it so that the
/// distortion is small, then the map is relaxed over it. \pre can_collapse
/// \return by how much the energy around is higher than it was, both with the scale that belongs to the smaller domain;
/// nothing, with nothing changed (but that the vertices opposite may have been anchored), where every centre that was
/// tried leaves a fold. What is taken back with `change` is the map, not the new vertex's embedding in `measures`
std::optional<double> collapse(LocalChange& change, SurfaceMeasures& measures, DomainSide side,
                               const CollapseOptions& options);
std::optional<double> collapse(WorkingMap& map, SurfaceMeasures& measures, DomainSide side,
                               const CollapseOptions& options, Scratch& scratch);

}  // namespace lozenge
