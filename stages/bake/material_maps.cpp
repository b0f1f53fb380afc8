// A texel is a square of the atlas. Where that lies on one source triangle, it is one filtered look-up; where it
// straddles others, the mean of four, each on its own triangle and with a quarter of the square: so no colour comes
// from beyond a border of the source's texture.
#include "stages/bake/material_maps.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>
#include <vector>

namespace lozenge {

namespace {

/// The mean of `look(footprint)` over a texel.
template <typename Look>
auto over_texel(const AtlasBaker& baker, const AtlasPlace& place, const Look& look) {
  const SourceFootprint whole = baker.footprint(place);
  if (whole.is_inside()) return look(whole);
  auto sum = look(whole) * 0.0;
  for (const double y : {-0.25, 0.25}) {
    for (const double x : {-0.25, 0.25}) {
      const AtlasPlace quarter = baker.atlas().inside({place.patch, place.x + x, place.y + y});
      sum += look(baker.footprint(quarter, 0.5)) * 0.25;
    }
  }
  return sum;
}

template <typename Value>
void store_shares(BakedMap& map, std::size_t texel, const Value& value) {
  for (int c = 0; c < map.channels; ++c) {
    map.texels[texel * static_cast<std::size_t>(map.channels) + static_cast<std::size_t>(c)] =
        static_cast<float>(std::clamp(value[c], 0.0, 1.0));
  }
}

/// Bilinear, in the tile of the texel's patch.
double occlusion_at(const BakedMap& occlusion, const MapTile& tile, const AtlasPlace& place) {
  const double shrink = occlusion.shrink;
  const auto find = [&](double at, std::int32_t first) {
    const std::int32_t begin = first / occlusion.shrink;
    const std::int32_t end = (first + tile.size) / occlusion.shrink;
    const double x = std::clamp((first + tile.gutter + at + 0.5) / shrink - 0.5, static_cast<double>(begin),
                                static_cast<double>(end - 1));
    const auto low = std::min(static_cast<std::int32_t>(x), end - 1);
    return std::tuple(low, std::min(low + 1, end - 1), x - low);
  };
  const auto [left, right, fx] = find(place.x, tile.x);
  const auto [top, bottom, fy] = find(place.y, tile.y);
  const auto at = [&](std::int32_t x, std::int32_t y) {
    return static_cast<double>(occlusion.texels[static_cast<std::size_t>(y) * occlusion.width() + x]);
  };
  return (at(left, top) * (1 - fx) + at(right, top) * fx) * (1 - fy) +
         (at(left, bottom) * (1 - fx) + at(right, bottom) * fx) * fy;
}

}  // namespace

BakedMap bake_base_colours(AtlasBaker& baker) {
  BakedMap map = baker.neutral(MapKind::kBaseColour, 1, baker.look().appearance().has_alpha ? 4 : 3);
  baker.bake_inner_texels("baking base colours", [&](const AtlasPlace& place, std::size_t texel) {
    store_shares(map, texel, over_texel(baker, place, [&](const SourceFootprint& footprint) {
                   return baker.look().base_colour(footprint);
                 }));
  });
  baker.continue_beyond_borders(map);
  return map;
}

BakedMap bake_occlusion_roughness_metal(AtlasBaker& baker, const BakedMap* occlusion) {
  BakedMap map = baker.neutral(MapKind::kOcclusionRoughnessMetal);
  baker.bake_inner_texels("baking roughness and metal", [&](const AtlasPlace& place, std::size_t texel) {
    Vec3d value = over_texel(baker, place, [&](const SourceFootprint& footprint) {
      return baker.look().occlusion_roughness_metal(footprint);
    });
    if (occlusion != nullptr) value.x *= occlusion_at(*occlusion, baker.atlas().tile(place.patch), place);
    store_shares(map, texel, value);
  });
  baker.continue_beyond_borders(map);
  return map;
}

BakedMap bake_emission(AtlasBaker& baker) {
  BakedMap map = baker.neutral(MapKind::kEmissive);
  baker.bake_inner_texels("baking emission", [&](const AtlasPlace& place, std::size_t texel) {
    store_shares(map, texel, over_texel(baker, place, [&](const SourceFootprint& footprint) {
                   return baker.look().emissive(footprint);
                 }));
  });
  baker.continue_beyond_borders(map);
  return map;
}

BakedMap bake_extension(AtlasBaker& baker, MapKind kind) {
  const MapTraits& traits = traits_of(kind);
  std::vector<const ExtensionTexture*> textures;
  std::int32_t channels = traits.fewest_channels != 0 ? traits.fewest_channels : traits.channels;
  for (const MaterialSlot slot : traits.slots) {
    const ExtensionTexture* row = extension_texture(slot);
    if (row == nullptr || !baker.look().appearance().has_extension_texture[static_cast<std::size_t>(row->role)])
      continue;
    textures.push_back(row);
    channels = std::max(channels, row->first_channel + row->channels);
  }
  BakedMap map = baker.neutral(kind, 1, channels);
  const std::string what = "baking " + std::string(traits.name);
  baker.bake_inner_texels(what, [&](const AtlasPlace& place, std::size_t texel) {
    store_shares(map, texel, over_texel(baker, place, [&](const SourceFootprint& footprint) {
                   Vec4d value(1, 1, 1, 1);
                   for (const ExtensionTexture* row : textures) {
                     const Vec4d found = baker.look().extension(footprint, row->role);
                     for (int c = row->first_channel; c < row->first_channel + row->channels; ++c) value[c] = found[c];
                   }
                   return value;
                 }));
  });
  baker.continue_beyond_borders(map);
  return map;
}

}  // namespace lozenge
