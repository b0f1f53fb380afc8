// Patches side by side: charts whose inner borders are none.
//
// Each patch of an atlas with tiles of its own is a chart, and all of its border is a seam. Where two neighbours lie in
// the atlas with their common side on each other, that side isn't. Going straight on from patch to patch, in over one
// side and out over the opposite one, such rows never overlap themselves: they are rectangles, which pack without
// gaps. A row of n patches has n - 1 of its 2 n sides inside.
#pragma once

#include <cstdint>
#include <vector>

#include "formats/base/vector.h"
#include "formats/patches/charted_surface.h"
#include "formats/patches/patch_layout.h"

namespace lozenge {

/// A patch in a strip: its square, turned counter-clockwise by so many quarters.
struct StripCell {
  std::int32_t patch = -1;
  int turns = 0;
};

/// Cell i covers x from i to i + 1, y from 0 to 1.
struct PatchStrip {
  std::vector<StripCell> cells;
  std::int32_t first_level = 0;  ///< of its patches

  std::int32_t length() const { return static_cast<std::int32_t>(cells.size()); }
};

/// Every patch in one strip, the longest ones first found, none longer than `longest`.
std::vector<PatchStrip> patch_strips(const PatchLayout& patches, std::int32_t longest);

/// Makes charts of strips: a triangle's `patch` is its strip then, and places are in the strip's coordinates. A corner
/// that two of a strip's patches share has the same bits for both.
void join_into_strips(ChartedSurface& surface, const std::vector<PatchStrip>& strips);

}  // namespace lozenge
