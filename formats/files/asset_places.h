// The parts of an asset in their places, as triangles of their own.
#pragma once

#include "formats/files/asset_file.h"

namespace lozenge {

/// The level as it stands in the scene at rest, each part once, in its first place: vertices and triangles keep their
/// numbers.
AssetLevel at_rest(const AssetLevel& level);

/// The level with all that the scene shows at rest: further places of a part come after that, with vertices and
/// triangles of their own.
AssetLevel with_copies(const AssetLevel& level);

}  // namespace lozenge
