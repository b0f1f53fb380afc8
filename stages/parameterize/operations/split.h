// Edge splits on the abstract domain: a vertex of four triangles more. What a collapse takes away in one place can be
// given to another.
#pragma once

#include <optional>

#include "stages/parameterize/map/local_change.h"
#include "stages/parameterize/map/working_map.h"
#include "stages/parameterize/relax/local_optimization.h"

namespace lozenge {

/// There is room for two more triangles and a vertex (what collapses have left), and for one more triangle around both
/// vertices opposite.
bool can_split(const WorkingMap& map, DomainSide side);

struct SplitResult {
  DomainVertex vertex = -1;  ///< the new one
  /// By how much the energy around is higher than it was (less than 0 where it is lower), both with the scale of the
  /// larger domain.
  double rise = 0;
};

/// Splits the side and carries every vertex at home in its two triangles along, through the star of the new vertex.
/// \pre can_split \return nothing, with nothing changed (but that the vertices opposite may have been anchored), where
/// every centre that was tried leaves a fold
std::optional<SplitResult> split(LocalChange& change, DomainSide side, const RelaxOptions& options);
std::optional<SplitResult> split(WorkingMap& map, DomainSide side, const RelaxOptions& options, Scratch& scratch);

}  // namespace lozenge
