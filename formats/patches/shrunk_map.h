// A baked map of lower resolution.
#pragma once

#include "formats/patches/baked_maps.h"

namespace lozenge {

/// Each texel the mean of `times` x `times` others, all of one tile; directions are unit vectors again.
/// \pre `times` divides the smallest tile of the map, in its texels
BakedMap shrunk(const BakedMap& map, std::int32_t times);

}  // namespace lozenge
