// Maps that nobody needs: what is the same everywhere is said by one number for each channel.
#pragma once

#include <optional>

#include "formats/patches/atlas.h"
#include "formats/patches/baked_maps.h"

namespace lozenge {

/// What all inner texels of a map hold, where it is the same to half a step of 8 bits, and the asset's material can say
/// it without the map (MapTraits::channels_without_factor). Nothing where it differs.
/// \pre the map has the layout's resolution
std::optional<ConstantMap> constant_of(const BakedMap& map, const Atlas& atlas);

}  // namespace lozenge
