// Where the source's surface is at every texel.
#pragma once

#include "stages/bake/atlas_baker.h"

namespace lozenge {

/// In the asset's units, always by the correspondence.
BakedMap bake_positions(AtlasBaker& baker);

}  // namespace lozenge
