// What a baked map promises: tiles that fit and that mips keep apart, numbers in the range of its kind.
#pragma once

#include "formats/patches/baked_maps.h"
#include "stages/check/check_report.h"

namespace lozenge {

/// Directions must be unit vectors to within one step of the map's `bits` (32: float).
CheckReport check_map(const BakedMap& map, int bits);

}  // namespace lozenge
