// A source vertex for a domain vertex that has none.
#pragma once

#include "stages/parameterize/map/scratch.h"
#include "stages/parameterize/map/working_map.h"

namespace lozenge {

/// Makes sure that a source vertex is pinned to `n`: the nearest is drawn to it.
/// \return false, with the map unchanged, where that can't be done without folds
bool ensure_anchor(WorkingMap& map, DomainVertex n, Scratch& scratch);
/// The same where `n` is regular: cones have theirs.
bool ensure_anchor_if_regular(WorkingMap& map, DomainVertex n, Scratch& scratch);

}  // namespace lozenge
