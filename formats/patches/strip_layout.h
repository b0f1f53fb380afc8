// Strips of patches packed in a square atlas.
#pragma once

#include <cstdint>
#include <vector>

#include "formats/base/vector.h"
#include "formats/patches/patch_strips.h"

namespace lozenge {

/// Where a strip lies: the middle of texel (x, y) is its place (0, 0), and a patch's side is so many texels on.
struct StripTile {
  std::int32_t x = 0;
  std::int32_t y = 0;
  std::int32_t steps = 0;   ///< texels from one side of a patch to the opposite one
  std::int32_t gutter = 0;  ///< texels around the strip that belong to it
};

struct StripLayout {
  std::int32_t size = 0;         ///< a side of the atlas, in texels
  std::vector<StripTile> tiles;  ///< [strip]

  /// Texture coordinates (glTF's convention, v down).
  Vec2d texcoord(std::int32_t strip, const Vec2d& place) const {
    const StripTile& tile = tiles[strip];
    return {(tile.x + 0.5 + place.x * tile.steps) / size, (tile.y + 0.5 + place.y * tile.steps) / size};
  }
};

/// The least side of an atlas that they fit into, in texels.
std::int64_t least_strip_size(const std::vector<PatchStrip>& strips, std::int32_t gutter);

/// The layout in which patches are largest; those of first level k have sides of 2^-k as many texels, but three at
/// least. \throws Error(kUsage) where `size` or `gutter` is out of range (1..kMostMapSize, 0..size), Error(kLimit)
/// where they don't fit
StripLayout pack_strips(const std::vector<PatchStrip>& strips, std::int32_t size, std::int32_t gutter);

}  // namespace lozenge
