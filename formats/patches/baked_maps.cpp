#include "formats/patches/baked_maps.h"

#include <algorithm>

namespace lozenge {

BakedMap neutral_map(MapKind kind, const MapLayout& layout, std::int32_t level, std::int32_t shrink,
                     std::int32_t channels) {
  const MapTraits& traits = traits_of(kind);
  BakedMap map{kind, layout, channels != 0 ? channels : traits.channels, {}, shrink, level};
  const std::size_t texels = static_cast<std::size_t>(map.width()) * map.height();
  map.texels.reserve(texels * map.channels);
  for (std::size_t t = 0; t < texels; ++t) {
    map.texels.insert(map.texels.end(), traits.neutral.begin(), traits.neutral.begin() + map.channels);
  }
  return map;
}

const BakedMap* find_map(const std::vector<BakedMap>& maps, MapKind kind) {
  const auto at = std::find_if(maps.begin(), maps.end(), [&](const BakedMap& map) { return map.kind == kind; });
  return at == maps.end() ? nullptr : &*at;
}

const BakedMap* BakedMaps::find(MapKind kind) const { return find_map(maps, kind); }

std::vector<ConstantMap> BakedMaps::constants() const {
  std::vector<ConstantMap> all;
  for (const BakedMap& map : maps) {
    for (const ConstantMap& constant : map.constants) {
      if (find(constant.kind) == nullptr) all.push_back(constant);
    }
  }
  return all;
}

const BakedMap* BakedMaps::find_in_level_frames() const {
  const auto at = std::find_if(maps.begin(), maps.end(),
                               [](const BakedMap& map) { return traits_of(map.kind).frames == Frames::kLevel; });
  return at == maps.end() ? nullptr : &*at;
}

void store(BakedMap& map, std::size_t texel, const Vec3f& value) {
  const Vec3f v = without_negative_zeros(value);
  for (int c = 0; c < 3; ++c) map.texels[3 * texel + static_cast<std::size_t>(c)] = v[c];
}

Vec3f load(const BakedMap& map, std::size_t texel) {
  return {map.texels[3 * texel], map.texels[3 * texel + 1], map.texels[3 * texel + 2]};
}

}  // namespace lozenge
