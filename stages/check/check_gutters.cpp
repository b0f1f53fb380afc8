#include "stages/check/check_gutters.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "formats/patches/atlas.h"
#include "formats/patches/shrunk_atlas.h"
#include "formats/patches/target_surface.h"
#include "stages/check/finding.h"

namespace lozenge {

namespace {

constexpr const char* kGutters = "gutters hold their neighbours' texels";
constexpr const char* kMips = "mips are filtered on the surface";

Vec3d direction_at(const BakedMap& map, std::size_t texel) {
  const float* t = &map.texels[3 * texel];
  return {t[0], t[1], t[2]};
}

/// A direction, and how far it may be from what was encoded.
struct Meaning {
  Vec3d direction;
  double error = 0;
};

/// What two texels mean, compared.
class Texels {
 public:
  Texels(const BakedMap& map, int bits, const GeometryImage& image, const Atlas& atlas)
      : map_(map),
        atlas_(atlas),
        target_(image, map.level, map.layout),
        half_step_(bits >= 32 ? 0 : 1 / (std::pow(2.0, bits) - 1)) {}

  bool agree(const AtlasPlace& a, const AtlasPlace& b) const {
    if (traits_of(map_.kind).frames == Frames::kLevel) {
      return agree(meaning(atlas_.texel_of(a), a), meaning(atlas_.texel_of(b), b));
    }
    const auto channels = static_cast<std::size_t>(map_.channels);
    const float* of_a = &map_.texels[atlas_.texel_of(a) * channels];
    return std::equal(of_a, of_a + channels, &map_.texels[atlas_.texel_of(b) * channels]);
  }

  /// The same of a texel of a shrunk map, and what is mixed of its owners.
  bool agree(std::size_t texel, const AtlasPlace& place, const TexelMix& mix) const {
    if (traits_of(map_.kind).values == MapValues::kDirections) return agree(meaning(texel, place), meaning(mix));
    for (std::int32_t c = 0; c < map_.channels; ++c) {
      if (!agree(texel, c, mix)) return false;
    }
    return true;
  }

 private:
  static bool agree(const Meaning& a, const Meaning& b) {
    return (a.direction - b.direction).length() <= a.error + b.error;
  }

  double number(std::size_t texel, std::int32_t channel) const {
    return map_.texels[texel * static_cast<std::size_t>(map_.channels) + static_cast<std::size_t>(channel)];
  }

  /// Between the mixes of the least and of the largest numbers that the file's integers can stand for.
  bool agree(std::size_t texel, std::int32_t channel, const TexelMix& mix) const {
    constexpr double kOfFloats = 1e-6;
    const MapTraits& traits = traits_of(map_.kind);
    double sum = 0;
    double least = 0;
    double most = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      const double value = number(mix.texels[k], channel);
      sum += mix.weights[k] * value;
      if (half_step_ == 0) continue;
      const double share = stored_share(traits, channel, value);
      const auto moved = [&](double by) {
        return mix.weights[k] * value_of_share(traits, channel, std::clamp(share + by, 0.0, 1.0));
      };
      least += moved(-0.5 * half_step_);
      most += moved(0.5 * half_step_);
    }
    const double found = number(texel, channel);
    if (half_step_ == 0) return std::abs(found - sum) <= kOfFloats * (1 + std::abs(sum));
    const double share = stored_share(traits, channel, found);
    const double slack = 0.5 * half_step_ + kOfFloats;
    return share >= stored_share(traits, channel, least) - slack &&
           share <= stored_share(traits, channel, most) + slack;
  }

  Meaning meaning(const TexelMix& mix) const {
    Vec3d sum(0, 0, 0);
    double error = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      const Meaning of_one = meaning(mix.texels[k], mix.places[k]);
      sum += of_one.direction * mix.weights[k];
      error += of_one.error * mix.weights[k];
    }
    return {sum.normalized(), 1.1 * error / std::max(sum.length(), 1e-9)};
  }

  /// Each component is off by half a step. Frames of coarse levels lean at creases: then directions are the differences
  /// of long vectors, and errors grow as these.
  Meaning meaning(std::size_t texel, const AtlasPlace& place) const {
    constexpr double kOfFloats = 1e-5;
    const Vec3d told = direction_at(map_, texel);
    if (traits_of(map_.kind).frames != Frames::kLevel) return {told.normalized(), 1.8 * half_step_ + kOfFloats};
    const Vec2d at = atlas_.nearest_of_own_patch(place) / atlas_.last(place.patch);
    const ShadingFrame frame = target_.at(place.patch, at.x, at.y).frame;
    const double length = (frame.tangent * told.x + frame.bitangent * told.y + frame.normal * told.z).length();
    const double widest = frame.tangent.length() + frame.bitangent.length() + frame.normal.length();
    return {frame.to_object(told), 1.1 * (half_step_ * widest + kOfFloats) / std::max(length, 1e-9)};
  }

  const BakedMap& map_;
  const Atlas& atlas_;
  TargetSurface target_;
  double half_step_;
};

bool check_belonging(const BakedMap& map, const GeometryImage& image, CheckReport& report) {
  const bool fits =
      map.layout.fits(image.layout) && map.level >= 0 && map.level < static_cast<int>(image.levels.size());
  report.add("tiles are those of the geometry image beside it", fits,
             fmt::format("{} tiles, {} patches", map.layout.patches(), image.size()));
  return fits;
}

/// Of a shrunk map: they are what a look-up in the patch beyond the border gives.
void compare_shrunk_gutters(const BakedMap& map, int bits, const GeometryImage& image, CheckReport& report) {
  const Atlas atlas(image, map.layout);
  const ShrunkAtlas shrunk(atlas, map.shrink);
  const Texels texels(map, bits, image, atlas);
  Finding differing;
  std::int64_t compared = 0;
  for (std::int32_t y = 0; y < map.height(); ++y) {
    for (std::int32_t x = 0; x < map.width(); ++x) {
      const AtlasPlace place = shrunk.place_of(x, y);
      if (place.patch < 0 || shrunk.is_own(place)) continue;
      ++compared;
      const TexelMix mix = shrunk.shown_at(place);
      const std::size_t texel = static_cast<std::size_t>(y) * static_cast<std::size_t>(map.width()) + x;
      if (texels.agree(texel, place, mix)) continue;
      differing.add([&] {
        return fmt::format("texel ({}, {}), of patch {}, isn't what patch {} shows there", x, y, place.patch,
                           mix.patch);
      });
    }
  }
  differing.report_to(report, kGutters, fmt::format("{} texels", compared));
}

void compare_gutters(const BakedMap& map, int bits, const GeometryImage& image, CheckReport& report) {
  const Atlas atlas(image, map.layout);
  const Texels texels(map, bits, image, atlas);
  Finding differing;
  std::int64_t compared = 0;
  for (std::int32_t patch = 0; patch < image.size(); ++patch) {
    const MapTile& tile = atlas.tile(patch);
    for (std::int32_t y = -tile.gutter; y < tile.inner() + tile.gutter; ++y) {
      for (std::int32_t x = -tile.gutter; x < tile.inner() + tile.gutter; ++x) {
        const AtlasPlace place{patch, static_cast<double>(x), static_cast<double>(y)};
        const AtlasPlace owner = atlas.first_name(atlas.inside(place));
        if (owner == place) continue;
        ++compared;
        if (texels.agree(place, owner)) continue;
        differing.add([&] {
          return fmt::format("texel ({}, {}) of patch {} isn't ({}, {}) of patch {}", x, y, patch, owner.x, owner.y,
                             owner.patch);
        });
      }
    }
  }
  differing.report_to(report, kGutters, fmt::format("{} texels", compared));
}

}  // namespace

void check_gutters(const BakedMap& map, int bits, const GeometryImage& image, CheckReport& report) {
  if (!check_belonging(map, image, report)) return;
  if (is_in_source_frames(map.kind)) return;
  if (map.shrink == 1) compare_gutters(map, bits, image, report);
  else compare_shrunk_gutters(map, bits, image, report);
}

void check_mips(const MapMips& maps, const GeometryImage& image, CheckReport& report) {
  // The reader has seen to it that levels are as many and as large as they must be.
  const std::vector<MipLevel> expected = surface_mips(maps.map, image.layout);
  const MapTraits& traits = traits_of(maps.map.kind);
  const double step = 1.01 / (std::pow(2.0, maps.bits) - 1);
  Finding differing;
  for (std::size_t l = 0; l < expected.size(); ++l) {
    for (std::size_t i = 0; i < expected[l].texels.size(); ++i) {
      const auto channel = static_cast<std::int32_t>(i % maps.map.channels);
      const double found = stored_share(traits, channel, maps.mips[l].texels[i]);
      if (std::abs(found - stored_share(traits, channel, expected[l].texels[i])) <= step) continue;
      differing.add([&] {
        const auto texel = static_cast<std::int32_t>(i / maps.map.channels);
        return fmt::format("texel ({}, {}) of mip {}", texel % expected[l].width, texel / expected[l].width, l + 1);
      });
    }
  }
  differing.report_to(report, kMips, fmt::format("{} below the map", expected.size()));
}

}  // namespace lozenge
