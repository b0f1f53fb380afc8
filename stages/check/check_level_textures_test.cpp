#include "stages/check/check_level_textures.h"

#include <gtest/gtest.h>

namespace lozenge {
namespace {

/// Two levels of one triangle, each of its own material with a texture for base colour.
Asset asset_of_widths(std::int32_t fine, std::int32_t coarse) {
  Asset asset;
  for (const std::int32_t width : {fine, coarse}) {
    AssetTexture texture;
    texture.width = texture.height = width;
    const auto number = static_cast<std::int32_t>(asset.textures.size());
    asset.textures.push_back(texture);
    asset.materials.emplace_back().texture(MaterialSlot::kBaseColour) = number;
    AssetLevel& level = asset.levels.emplace_back();
    level.triangles.push_back({0, 1, 2});
    level.material = number;
  }
  return asset;
}

bool passes(const Asset& asset) {
  CheckReport report;
  check_level_textures(asset, report);
  return report.passed();
}

TEST(CheckLevelTextures, PassesForTexturesOfTheFinestAndForOwnOnesThatAreSmallerByHalves) {
  for (const std::int32_t width : {256, 128, 32}) EXPECT_TRUE(passes(asset_of_widths(256, width))) << width;
  Asset shared = asset_of_widths(256, 100);
  shared.levels[1].material = 0;
  EXPECT_TRUE(passes(shared));
}

TEST(CheckLevelTextures, RefusesTexturesOfOtherSizesOrForOtherSlots) {
  for (const std::int32_t width : {512, 200, 0}) EXPECT_FALSE(passes(asset_of_widths(256, width))) << width;
  Asset narrow = asset_of_widths(256, 128);
  narrow.textures[1].height = 64;
  EXPECT_FALSE(passes(narrow));
  Asset other = asset_of_widths(256, 128);
  std::swap(other.materials[1].texture(MaterialSlot::kBaseColour), other.materials[1].texture(MaterialSlot::kEmissive));
  EXPECT_FALSE(passes(other));
  Asset normals = asset_of_widths(256, 128);
  normals.materials[1].texture(MaterialSlot::kNormal) = 0;
  EXPECT_TRUE(passes(normals)) << "of which each level has its own, or none";
}

}  // namespace
}  // namespace lozenge
