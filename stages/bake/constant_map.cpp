#include "stages/bake/constant_map.h"

#include <algorithm>

namespace lozenge {

namespace {

struct Extent {
  float least = 0;
  float most = 0;
};

/// Whether integers of 8 bits hardly tell the values apart.
bool are_the_same(const MapTraits& traits, std::int32_t channel, const Extent& values) {
  constexpr double kHalfAStep = 0.5 / 255;
  return stored_share(traits, channel, values.most) - stored_share(traits, channel, values.least) < kHalfAStep;
}

}  // namespace

std::optional<ConstantMap> constant_of(const BakedMap& map, const Atlas& atlas) {
  const MapTraits& traits = traits_of(map.kind);
  if (traits.channels_without_factor < 0) return std::nullopt;
  std::array<Extent, 4> extents;
  bool is_first = true;
  for (std::int32_t patch = 0; patch < atlas.patches(); ++patch) {
    const std::int32_t side = atlas.tile(patch).inner();
    for (std::int32_t y = 0; y < side; ++y) {
      for (std::int32_t x = 0; x < side; ++x) {
        const AtlasPlace place{patch, static_cast<double>(x), static_cast<double>(y)};
        if (!atlas.exists(place)) continue;
        const float* texel = &map.texels[atlas.texel_of(place) * static_cast<std::size_t>(map.channels)];
        for (std::int32_t c = 0; c < map.channels; ++c) {
          Extent& extent = extents[static_cast<std::size_t>(c)];
          extent.least = is_first ? texel[c] : std::min(extent.least, texel[c]);
          extent.most = is_first ? texel[c] : std::max(extent.most, texel[c]);
        }
        is_first = false;
      }
      for (std::int32_t c = 0; c < map.channels; ++c) {
        if (!are_the_same(traits, c, extents[static_cast<std::size_t>(c)])) return std::nullopt;
      }
    }
  }
  ConstantMap constant{map.kind, {1, 1, 1, 1}};
  for (std::int32_t c = 0; c < map.channels; ++c) {
    const auto channel = static_cast<std::size_t>(c);
    constant.value[channel] = 0.5F * (extents[channel].least + extents[channel].most);
    const Extent to_neutral{std::min(constant.value[channel], traits.neutral[channel]),
                            std::max(constant.value[channel], traits.neutral[channel])};
    if (c < traits.channels_without_factor && !are_the_same(traits, c, to_neutral)) return std::nullopt;
  }
  return constant;
}

}  // namespace lozenge
