// The working map as what the stage hands out.
#pragma once

#include "formats/domain/parameterization.h"
#include "stages/parameterize/map/working_map.h"

namespace lozenge {

/// The map on the lattice of the file; the domain renumbered without gaps.
Parameterization finished(const WorkingMap& map);

}  // namespace lozenge
