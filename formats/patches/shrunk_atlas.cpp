#include "formats/patches/shrunk_atlas.h"

#include <algorithm>
#include <cmath>

#include "formats/base/parallel.h"

namespace lozenge {

namespace {

/// The frame at a place, or at the nearest one that its patch has.
ShadingFrame frame_at(const Atlas& atlas, const AtlasPlace& place, const TargetSurface& surface) {
  const Vec2d at = atlas.nearest_of_own_patch(place) / atlas.last(place.patch);
  return surface.at(place.patch, at.x, at.y).frame;
}

/// A mix of directions, unit; of opposite ones nothing is left, and the heaviest stands for all.
Vec3d mixed_direction(const BakedMap& map, const TexelMix& mix, const Atlas& atlas, const TargetSurface& surface) {
  Vec3d sum(0, 0, 0);
  std::array<Vec3d, 4> directions;
  for (std::size_t k = 0; k < 4; ++k) {
    directions[k] = object_direction(map, mix.texels[k], atlas, mix.places[k], surface);
    sum += directions[k] * mix.weights[k];
  }
  const auto heaviest = std::max_element(mix.weights.begin(), mix.weights.end()) - mix.weights.begin();
  return sum.length() > 0 ? sum.normalized() : directions[static_cast<std::size_t>(heaviest)];
}

}  // namespace

ShrunkAtlas::ShrunkAtlas(const Atlas& atlas, std::int32_t shrink) : atlas_(atlas), shrink_(shrink) {}

AtlasPlace ShrunkAtlas::place_of(std::int32_t x, std::int32_t y) const {
  const double half = 0.5 * shrink_ - 0.5;
  return atlas_.place_at(static_cast<double>(x) * shrink_ + half, static_cast<double>(y) * shrink_ + half);
}

/// Along a border texels lie beside those of the neighbour, for tiles are multiples of them; across it between two.
TexelMix ShrunkAtlas::shown_at(const AtlasPlace& place) const {
  const AtlasPlace owner = atlas_.inside(place);
  const MapTile& tile = atlas_.tile(owner.patch);
  const double shrink = shrink_;
  // In texels of the map, from the middle of the tile's first one; and those of them whose middles the patch has.
  const auto of_map = [&](double at) { return (tile.gutter + at + 0.5) / shrink - 0.5; };
  const double first = std::ceil(of_map(0));
  const double last = std::max(first, std::floor(of_map(atlas_.last(owner.patch))));
  struct Between {
    std::int32_t low;
    std::int32_t high;
    double share;
  };
  const auto between = [&](double at) {
    const double x = std::clamp(of_map(at), first, last);
    const auto low = static_cast<std::int32_t>(std::floor(x));
    return Between{low, std::min(low + 1, static_cast<std::int32_t>(last)), x - low};
  };
  const Between x = between(owner.x);
  const Between y = between(owner.y);
  TexelMix mix;
  mix.patch = owner.patch;
  for (std::size_t k = 0; k < 4; ++k) {
    std::int32_t i = k % 2 == 0 ? x.low : x.high;
    std::int32_t j = k < 2 ? y.low : y.high;
    mix.weights[k] = (k % 2 == 0 ? 1 - x.share : x.share) * (k < 2 ? 1 - y.share : y.share);
    const auto place_of_texel = [&] {
      const auto middle = [&](std::int32_t n) { return (n + 0.5) * shrink - 0.5 - tile.gutter; };
      return AtlasPlace{owner.patch, middle(i), middle(j)};
    };
    // Beyond the surface's boundary a half patch is mirrored, its texels too.
    if (!atlas_.exists(place_of_texel())) std::swap(i, j);
    mix.places[k] = place_of_texel();
    mix.texels[k] = atlas_.layout().texel_of(tile, i, j, shrink_);
  }
  return mix;
}

bool is_in_source_frames(MapKind kind) {
  return traits_of(kind).frames == Frames::kSource || kind == MapKind::kClearcoatNormal || kind == MapKind::kAnisotropy;
}

Vec3d object_direction(const BakedMap& map, std::size_t texel, const Atlas& atlas, const AtlasPlace& place,
                       const TargetSurface& surface) {
  const Vec3d told(load(map, texel));
  return traits_of(map.kind).frames == Frames::kLevel ? frame_at(atlas, place, surface).to_object(told) : told;
}

void continue_beyond_borders(BakedMap& map, const Atlas& atlas, const TargetSurface& surface) {
  const ShrunkAtlas shrunk(atlas, map.shrink);
  const MapTraits& traits = traits_of(map.kind);
  const auto channels = static_cast<std::size_t>(map.channels);
  for_each_index(static_cast<std::size_t>(map.height()), true, [&](std::size_t row) {
    for (std::int32_t x = 0; x < map.width(); ++x) {
      const AtlasPlace place = shrunk.place_of(x, static_cast<std::int32_t>(row));
      if (place.patch < 0 || shrunk.is_own(place)) continue;
      const TexelMix mix = shrunk.shown_at(place);
      const std::size_t texel = row * static_cast<std::size_t>(map.width()) + static_cast<std::size_t>(x);
      if (traits.values == MapValues::kDirections) {
        const Vec3d direction = mixed_direction(map, mix, atlas, surface);
        const bool is_of_level = traits.frames == Frames::kLevel;
        store(map, texel, Vec3f(is_of_level ? frame_at(atlas, place, surface).to_texel(direction) : direction));
        continue;
      }
      for (std::size_t c = 0; c < channels; ++c) {
        double sum = 0;
        for (std::size_t k = 0; k < 4; ++k) sum += map.texels[mix.texels[k] * channels + c] * mix.weights[k];
        map.texels[texel * channels + c] = static_cast<float>(sum + 0.0);
      }
    }
  });
}

}  // namespace lozenge
