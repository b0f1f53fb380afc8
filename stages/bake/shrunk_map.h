// A baked map of lower resolution.
#pragma once

#include "formats/patches/baked_maps.h"

namespace lozenge {

/// Each texel the mean of `shrink` x `shrink` others, all of one tile; directions are unit vectors again.
/// \pre `shrink` divides the smallest tile, and the map has the layout's resolution
BakedMap shrunk(const BakedMap& map, std::int32_t shrink);

}  // namespace lozenge
