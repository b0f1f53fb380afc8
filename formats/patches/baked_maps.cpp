#include "formats/patches/baked_maps.h"

#include <fmt/format.h>

#include <algorithm>

#include "formats/base/error.h"

namespace lozenge {

std::int64_t least_map_size(std::int32_t columns, std::int32_t rows, std::int32_t gutter) {
  const std::int64_t least_inner = std::max<std::int64_t>(4, std::int64_t{gutter} + 1);
  return (least_inner + 2 * std::int64_t{gutter}) * std::max({columns, rows, 1});
}

MapLayout make_map_layout(std::int32_t columns, std::int32_t rows, std::int32_t size, std::int32_t gutter) {
  if (size < 1 || size > kMostMapSize) {
    throw Error(
        ExitCode::kUsage,
        fmt::format("a texture of {0} x {0} texels can't be made; choose 1 to {1} texels a side", size, kMostMapSize));
  }
  if (gutter < 0 || gutter > size) {
    throw Error(ExitCode::kUsage, fmt::format("a gutter of {} texels is out of range; choose 0 to {}", gutter, size));
  }
  MapLayout layout{size, size, columns, rows, size / std::max({columns, rows, 1}), gutter};
  const std::int64_t enough = least_map_size(columns, rows, gutter);
  if (size < enough) {
    throw Error(ExitCode::kLimit,
                fmt::format("{} x {} patches with gutters of {} texels don't fit into a texture of {} x {} texels; "
                            "choose at least {} texels a side, or a smaller gutter",
                            columns, rows, gutter, size, size, enough));
  }
  return layout;
}

BakedMap neutral_map(MapKind kind, const MapLayout& layout, std::int32_t level, std::int32_t shrink) {
  const MapTraits& traits = traits_of(kind);
  BakedMap map{kind, layout, traits.channels, {}, shrink, level};
  const std::size_t texels = static_cast<std::size_t>(map.width()) * map.height();
  map.texels.reserve(texels * traits.channels);
  for (std::size_t t = 0; t < texels; ++t) {
    map.texels.insert(map.texels.end(), traits.neutral.begin(), traits.neutral.begin() + traits.channels);
  }
  return map;
}

const BakedMap* BakedMaps::find(MapKind kind) const {
  const auto at = std::find_if(maps.begin(), maps.end(), [&](const BakedMap& map) { return map.kind == kind; });
  return at == maps.end() ? nullptr : &*at;
}

const BakedMap* BakedMaps::find_in_level_frames() const {
  const auto at =
      std::find_if(maps.begin(), maps.end(), [](const BakedMap& map) { return traits_of(map.kind).in_level_frames; });
  return at == maps.end() ? nullptr : &*at;
}

}  // namespace lozenge
