#include "stages/check/check_level_textures.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>

#include "stages/check/finding.h"

namespace lozenge {

namespace {

/// [slot] index of a texture, or -1.
using Textures = std::array<std::int32_t, kMaterialSlots>;

/// Of a level's materials, but for normals.
std::set<Textures> textures_of(const Asset& asset, const AssetLevel& level) {
  std::set<Textures> found;
  for (std::size_t t = 0; t < level.triangles.size(); ++t) {
    const std::int32_t m = level.material_of(static_cast<TriangleId>(t));
    if (m < 0 || m >= static_cast<std::int32_t>(asset.materials.size())) continue;
    Textures textures = asset.materials[static_cast<std::size_t>(m)].textures;
    textures[static_cast<std::size_t>(MaterialSlot::kNormal)] = -1;
    found.insert(textures);
  }
  return found;
}

bool is_smaller_by_halves(const AssetTexture& coarse, const AssetTexture& fine) {
  for (std::int32_t times = 1; coarse.width > 0 && times * coarse.width <= fine.width; times *= 2) {
    if (times * coarse.width == fine.width && times * coarse.height == fine.height) return true;
  }
  return false;
}

bool are_of_one_atlas(const Asset& asset, const Textures& coarse, const Textures& fine) {
  const auto count = static_cast<std::int32_t>(asset.textures.size());
  for (std::size_t slot = 0; slot < kMaterialSlots; ++slot) {
    if (coarse[slot] == fine[slot]) continue;
    const auto is_there = [&](std::int32_t texture) { return texture >= 0 && texture < count; };
    if (!is_there(coarse[slot]) || !is_there(fine[slot])) return false;
    const auto texture = [&](std::int32_t number) -> const AssetTexture& {
      return asset.textures[static_cast<std::size_t>(number)];
    };
    if (!is_smaller_by_halves(texture(coarse[slot]), texture(fine[slot]))) return false;
  }
  return true;
}

}  // namespace

void check_level_textures(const Asset& asset, CheckReport& report) {
  Finding other;
  const std::set<Textures> finest = textures_of(asset, asset.levels[0]);
  for (std::size_t l = 1; l < asset.levels.size(); ++l) {
    for (const Textures& here : textures_of(asset, asset.levels[l])) {
      const bool fits = std::any_of(finest.begin(), finest.end(),
                                    [&](const Textures& fine) { return are_of_one_atlas(asset, here, fine); });
      if (fits) continue;
      other.add([&] {
        return fmt::format("level {} ({} triangles) has textures that are neither level 0's nor of its atlas", l,
                           asset.levels[l].triangles.size());
      });
    }
  }
  other.report_to(report, "levels share one atlas: the finest's textures, or their own of it",
                  fmt::format("{} levels", asset.levels.size()));
}

}  // namespace lozenge
