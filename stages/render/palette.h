// Colours that go together, and that neighbours do not share.
#pragma once

#include <cstdint>
#include <vector>

#include "stages/render/picture.h"

namespace lozenge {

/// The plain material of everything that isn't coloured.
Vec3f clay();

/// Colour `index` of a set of distinct, light colours; any index.
Vec3f patch_colour(std::int32_t index);

/// [item] a small colour index, such that items that share a group (the triangles around a vertex) differ, and that
/// items far apart do not all take the first colours. \param groups  each lists the items that must differ
std::vector<std::int32_t> colour_items(std::int32_t items, const std::vector<std::vector<std::int32_t>>& groups);

}  // namespace lozenge
