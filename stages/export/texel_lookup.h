// Look-ups in a baked map at places of patches, as bilinear filtering makes them.
#pragma once

#include <algorithm>
#include <cstdint>

#include "formats/base/vector.h"
#include "formats/patches/atlas.h"
#include "formats/patches/baked_maps.h"

namespace lozenge {

/// What bilinear filtering shows of a map at a place of a patch (shares of its side), within the patch's tile.
/// \param value  of a texel's index: a vector
template <typename Value>
auto between_texels(const BakedMap& map, const Atlas& atlas, std::int32_t patch, const Vec2d& place,
                    const Value& value) {
  const MapTile& tile = atlas.tile(patch);
  const std::int32_t texels = tile.size / map.shrink;
  const double half = 0.5 * map.shrink - 0.5;
  const Vec2d at =
      (place * atlas.last(patch) + Vec2d(tile.gutter - half, tile.gutter - half)) / static_cast<double>(map.shrink);
  const double x = std::clamp(at.x, 0.0, static_cast<double>(texels - 1));
  const double y = std::clamp(at.y, 0.0, static_cast<double>(texels - 1));
  const auto i = std::clamp(static_cast<std::int32_t>(x), 0, std::max(texels - 2, 0));
  const auto j = std::clamp(static_cast<std::int32_t>(y), 0, std::max(texels - 2, 0));
  const auto texel = [&](std::int32_t dx, std::int32_t dy) {
    return value(map.layout.texel_of(tile, std::min(i + dx, texels - 1), std::min(j + dy, texels - 1), map.shrink));
  };
  const double u = x - i;
  const double v = y - j;
  return (texel(0, 0) * (1 - u) + texel(1, 0) * u) * (1 - v) + (texel(0, 1) * (1 - u) + texel(1, 1) * u) * v;
}

}  // namespace lozenge
