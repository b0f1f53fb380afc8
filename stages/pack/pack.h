// Patches packed into an atlas, with every level of detail (paper, Sec. 6.0.1 and Fig. 7).
#pragma once

#include "formats/patches/geometry_image.h"
#include "formats/patches/patch_set.h"

namespace lozenge {

struct PackOptions {
  /// Tiles side by side; 0 takes ceil(sqrt(patches)), the squarest picture.
  std::int32_t columns = 0;
};

/// Tiles side by side in the atlas of so many patches.
std::int32_t atlas_columns(std::int32_t patches, const PackOptions& options);

/// Patch p becomes the tile in column p % columns and row p / columns. Level l has every 2^l-th sample of a patch of
/// first level 0, every 2^(l-k)-th of one of first level k <= l, bit for bit, down to 2 samples a side. \throws
/// Error(kUsage) where there are negative columns, or more of them than patches; Error(kInternal) where the patch set's
/// arrays don't fit its N
GeometryImage pack(const PatchSet& patches, const PackOptions& options = {});

}  // namespace lozenge
