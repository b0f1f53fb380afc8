// The copies of an asset's parts, as triangles of their own.
#pragma once

#include "formats/files/asset_file.h"

namespace lozenge {

/// The level with all that the scene shows, each copy with vertices and triangles of its own.
AssetLevel with_copies(const AssetLevel& level);

}  // namespace lozenge
