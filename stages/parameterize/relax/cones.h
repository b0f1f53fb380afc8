// Optimizing irregular vertices in their stars (paper, Sec. 5.6).
#pragma once

#include <optional>

#include "stages/parameterize/map/local_change.h"
#include "stages/parameterize/relax/local_optimization.h"

namespace lozenge {

/// Of a star whose cone has moved: it relaxed in the polygon before, so less is left to do than after other operations.
inline constexpr RelaxOptions kRelaxStar{3, 1e-2};

/// Lets an irregular vertex crawl over the surface (5.6): optimizes its star in the polygon with nothing pinned, takes
/// the source vertex that is nearest to the centre then, and maps back; on the boundary, `crawl`s along it.
/// \return by how much the energy rose, less than 0; nothing, with nothing changed, where the true distortion around
/// doesn't fall
std::optional<double> optimize_cone(LocalChange& change, DomainVertex n, const RelaxOptions& options);
std::optional<double> optimize_cone(WorkingMap& map, DomainVertex n, const RelaxOptions& options, Scratch& scratch);

}  // namespace lozenge
