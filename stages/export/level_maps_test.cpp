// What levels of detail show of the source's colours, read back from the asset.
#include <gtest/gtest.h>

#include <cmath>

#include "formats/base/file_fixtures.h"
#include "formats/domain/sphere_fixtures.h"
#include "formats/files/asset_file.h"
#include "formats/patches/atlas.h"
#include "formats/patches/target_surface.h"
#include "stages/export/export.h"
#include "stages/export/export_fixtures.h"

namespace lozenge {
namespace {

/// The octahedron's sphere, whose occlusion, roughness and metal say where on it they are.
class LevelMapsOfABall : public testing::Test {
 protected:
  LevelMapsOfABall() {
    const Domain domain = fixtures::octahedron();
    std::tie(mesh_, map_) = fixtures::subdivided_sphere(domain, 30);
    image_ = export_fixtures::sphere(domain, export_fixtures::octahedron_places(), 9);
    BakedMap told = neutral_map(MapKind::kOcclusionRoughnessMetal, make_map_layout(image_.layout, 256, 4), 0);
    const Atlas atlas(image_, told.layout);
    const TargetSurface surface(image_, 0, told.layout);
    for (std::int32_t y = 0; y < told.height(); ++y) {
      for (std::int32_t x = 0; x < told.width(); ++x) {
        const AtlasPlace place = atlas.place_at(x, y);
        if (place.patch < 0) continue;
        const AtlasPlace inside = atlas.inside(place);
        const Vec2d share = atlas.share_of(inside);
        const Vec3d at = surface.at(inside.patch, share.x, share.y).position.normalized();
        store(told, static_cast<std::size_t>(y * told.width() + x), Vec3f(told_at(at)));
      }
    }
    maps_.maps.push_back(std::move(told));
  }

  static Vec3d told_at(const Vec3d& place) { return (place + Vec3d(1, 1, 1)) / 2; }

  Asset write(LevelMapsOf maps_of) {
    const SourceSurface source{&mesh_, &map_};
    ExportOptions options;
    options.finest = Finest::kSource;
    options.level_maps = maps_of;
    export_asset(folder_ / "ball.glb", image_, maps_, options, &source);
    return read_asset(folder_ / "ball.glb");
  }

  static std::int32_t texture_of(const Asset& asset, const AssetLevel& level) {
    return asset.materials.at(static_cast<std::size_t>(level.material_of(0))).texture(MaterialSlot::kMetallicRoughness);
  }

  /// Between the middles of texels.
  static Vec3d shown_at(const AssetTexture& texture, const Vec2d& uv) {
    const double x = uv.x * texture.width - 0.5;
    const double y = uv.y * texture.height - 0.5;
    Vec3d sum(0, 0, 0);
    for (int k = 0; k < 4; ++k) {
      const auto i = static_cast<std::int32_t>(x) + k % 2;
      const auto j = static_cast<std::int32_t>(y) + k / 2;
      const float* texel = &texture.pixels[3 * static_cast<std::size_t>(j * texture.width + i)];
      sum += Vec3d(texel[0], texel[1], texel[2]) * ((1 - std::abs(x - i)) * (1 - std::abs(y - j)));
    }
    return sum;
  }

  /// The mean distance, over the middles of a level's triangles, between what its texture says and where they are.
  static double mean_error(const Asset& asset, const AssetLevel& level) {
    const AssetTexture& texture = asset.textures.at(static_cast<std::size_t>(texture_of(asset, level)));
    double sum = 0;
    for (const auto& t : level.triangles) {
      Vec3d middle(0, 0, 0);
      Vec2d uv(0, 0);
      for (const VertexId v : t) {
        middle += Vec3d(level.positions[v]);
        uv += Vec2d(level.uvs[v]) / 3;
      }
      sum += (shown_at(texture, uv) - told_at(middle.normalized())).length();
    }
    return sum / static_cast<double>(level.triangles.size());
  }

  SourceMesh mesh_;
  Parameterization map_;
  GeometryImage image_;
  BakedMaps maps_;
  fixtures::TestFolder folder_;
};

TEST_F(LevelMapsOfABall, ShowThePlaceOfTheSourceThatIsSeen) {
  const Asset asset = write(LevelMapsOf::kLevels);
  ASSERT_GE(asset.levels.size(), 3U);
  for (const AssetLevel& level : asset.levels) EXPECT_LT(mean_error(asset, level), 0.012) << level.triangles.size();
}

TEST_F(LevelMapsOfABall, AreHalfTheSideOfThoseOfTheLevelBefore) {
  const Asset asset = write(LevelMapsOf::kLevels);
  ASSERT_GE(asset.levels.size(), 3U);
  std::vector<std::int32_t> widths;
  for (const AssetLevel& level : asset.levels) {
    widths.push_back(asset.textures.at(static_cast<std::size_t>(texture_of(asset, level))).width);
  }
  widths.resize(3);
  EXPECT_EQ(widths, (std::vector<std::int32_t>{256, 128, 64}));
}

TEST_F(LevelMapsOfABall, AreThoseOfTheAssetWhereTheyShallBeShared) {
  const Asset asset = write(LevelMapsOf::kAsset);
  ASSERT_GE(asset.levels.size(), 3U);
  EXPECT_EQ(asset.textures.size(), 1U);
  for (const AssetLevel& level : asset.levels) EXPECT_EQ(texture_of(asset, level), texture_of(asset, asset.levels[0]));
}

}  // namespace
}  // namespace lozenge
