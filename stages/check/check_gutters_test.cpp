#include "stages/check/check_gutters.h"

#include <gtest/gtest.h>

#include <array>
#include <random>
#include <string>

#include "formats/base/file_fixtures.h"
#include "formats/domain/open_fixtures.h"
#include "formats/domain/sphere_fixtures.h"
#include "formats/files/baked_maps_file.h"
#include "formats/files/geometry_image_file.h"
#include "formats/patches/atlas.h"
#include "formats/patches/image_fixtures.h"
#include "formats/patches/shrunk_atlas.h"
#include "formats/patches/target_surface.h"
#include "stages/check/check.h"

namespace lozenge {
namespace {

constexpr const char* kGutters = "gutters hold their neighbours' texels";
constexpr const char* kMips = "mips are filtered on the surface";
constexpr const char* kTiles = "tiles are those of the geometry image beside it";

std::vector<GeometryImage> images() {
  return {fixtures::sphere_image(fixtures::icosahedron(), 3), fixtures::open_image(fixtures::hemisphere(12), 3)};
}

/// Noise, the same for all texels that show one place; tangent-space normals say in each patch's frames what one
/// direction for each place is.
BakedMap noise(MapKind kind, const GeometryImage& image) {
  BakedMap map = neutral_map(kind, make_map_layout(image.layout, 256, 4), 0);
  const Atlas atlas(image, map.layout);
  const TargetSurface surface(image, 0, map.layout);
  for (std::int32_t p = 0; p < image.size(); ++p) {
    const MapTile tile = map.layout.tile_of(p);
    for (std::int32_t y = -tile.gutter; y < tile.inner() + tile.gutter; ++y) {
      for (std::int32_t x = -tile.gutter; x < tile.inner() + tile.gutter; ++x) {
        const AtlasPlace place{p, static_cast<double>(x), static_cast<double>(y)};
        const AtlasPlace owner = atlas.first_name(atlas.inside(place));
        const auto number = static_cast<unsigned>(atlas.texel_of(owner));
        float* texel = &map.texels[atlas.texel_of(place) * static_cast<std::size_t>(map.channels)];
        const auto digit = [&](unsigned c) {
          return static_cast<float>((number * 2654435761U >> (8 * c)) % 256) / 255;
        };
        for (std::int32_t c = 0; c < map.channels; ++c) texel[c] = digit(static_cast<unsigned>(c));
        if (kind != MapKind::kTangentNormal) continue;
        const Vec2d at = atlas.nearest_of_own_patch(place) / atlas.last(p);
        const Vec2d of_owner = atlas.share_of(owner);
        const Vec3d leaning(digit(0) - 0.5, digit(1) - 0.5, digit(2) - 0.5);
        const Vec3d normal = surface.at(owner.patch, of_owner.x, of_owner.y).frame.normal + leaning;
        const Vec3f stored(surface.at(p, at.x, at.y).frame.to_texel(normal.normalized()));
        for (int c = 0; c < 3; ++c) texel[c] = stored[c];
      }
    }
  }
  return map;
}

/// Of less than the atlas's resolution: noise in patches, and beyond their borders what that continues. Directions lean
/// away from the surface's normals, so that those of neighbours can be mixed.
BakedMap shrunk_noise(MapKind kind, const GeometryImage& image, std::int32_t shrink) {
  BakedMap map = neutral_map(kind, make_map_layout(image.layout, 256, 4), 0, shrink);
  const Atlas atlas(image, map.layout);
  const ShrunkAtlas shrunk(atlas, shrink);
  const TargetSurface surface(image, 0, map.layout);
  std::minstd_rand random(7);
  const auto share = [&] { return static_cast<float>(random() % 256) / 255; };
  for (std::int32_t y = 0; y < map.height(); ++y) {
    for (std::int32_t x = 0; x < map.width(); ++x) {
      const AtlasPlace place = shrunk.place_of(x, y);
      if (place.patch < 0 || !shrunk.is_own(place)) continue;
      const auto texel = static_cast<std::size_t>(y * map.width() + x);
      for (std::int32_t c = 0; c < map.channels; ++c) map.texels[texel * map.channels + c] = share();
      if (traits_of(kind).values != MapValues::kDirections) continue;
      const Vec2d at = atlas.share_of(place);
      const ShadingFrame frame = surface.at(place.patch, at.x, at.y).frame;
      const Vec3d leaning(share() - 0.5, share() - 0.5, share() - 0.5);
      const Vec3d direction = (frame.normal + leaning).normalized();
      store(map, texel, Vec3f(kind == MapKind::kTangentNormal ? frame.to_texel(direction) : direction));
    }
  }
  continue_beyond_borders(map, atlas, surface);
  return map;
}

TEST(CheckGutters, PassForSmallMapsWhoseGuttersAreWhatLookUpsBeyondTheBorderGive) {
  for (const GeometryImage& image : images()) {
    for (const MapKind kind :
         {MapKind::kOcclusion, MapKind::kBaseColour, MapKind::kTangentNormal, MapKind::kObjectNormal}) {
      for (const std::int32_t shrink : {2, 4, 8}) {
        for (const int bits : {8, 16}) {
          CheckReport report;
          check_gutters(as_stored(shrunk_noise(kind, image, shrink), true, bits), bits, image, report);
          ASSERT_NE(report.find(kGutters), nullptr);
          EXPECT_TRUE(report.find(kGutters)->passed) << traits_of(kind).name << ": " << report.find(kGutters)->detail;
          EXPECT_NE(report.find(kGutters)->detail, "0 texels");
        }
      }
    }
  }
}

TEST(CheckGutters, FindOneTexelOfASmallMapThatDiffers) {
  for (const GeometryImage& image : images()) {
    for (const MapKind kind : {MapKind::kOcclusion, MapKind::kBaseColour, MapKind::kTangentNormal}) {
      for (const std::int32_t shrink : {2, 4}) {
        BakedMap map = as_stored(shrunk_noise(kind, image, shrink), true, 8);
        // The first of a tile is in its gutter.
        const MapTile tile = map.layout.tile_of(2);
        const auto texel = static_cast<std::size_t>((tile.y / shrink + 1) * map.width() + tile.x / shrink);
        float& number = map.texels[texel * static_cast<std::size_t>(map.channels)];
        number += number > 0.5F ? -0.25F : 0.25F;
        CheckReport report;
        check_gutters(map, 8, image, report);
        ASSERT_NE(report.find(kGutters), nullptr);
        EXPECT_FALSE(report.find(kGutters)->passed) << traits_of(kind).name;
        EXPECT_NE(report.find(kGutters)->detail.find("of patch 2, isn't"), std::string::npos)
            << report.find(kGutters)->detail;
        EXPECT_EQ(report.find(kGutters)->detail.find("of 2 places"), std::string::npos) << "one, and no other";
      }
    }
  }
}

TEST(CheckGutters, SayNothingOfMapsInTheFramesOfTheSource) {
  const GeometryImage image = images()[0];
  for (const MapKind kind : {MapKind::kSourceNormal, MapKind::kClearcoatNormal, MapKind::kAnisotropy}) {
    CheckReport report;
    check_gutters(neutral_map(kind, make_map_layout(image.layout, 256, 4), 0), 8, image, report);
    EXPECT_EQ(report.find(kGutters), nullptr) << traits_of(kind).name;
    EXPECT_NE(report.find(kTiles), nullptr);
  }
}

TEST(CheckGutters, PassForMapsThatContinueIntoTheirNeighbours) {
  for (const GeometryImage& image : images()) {
    for (const MapKind kind : {MapKind::kOcclusion, MapKind::kBaseColour, MapKind::kTangentNormal}) {
      for (const int bits : {8, 16}) {
        CheckReport report;
        check_gutters(as_stored(noise(kind, image), true, bits), bits, image, report);
        ASSERT_NE(report.find(kGutters), nullptr);
        EXPECT_TRUE(report.find(kGutters)->passed) << traits_of(kind).name << ": " << report.find(kGutters)->detail;
      }
    }
  }
}

TEST(CheckGutters, FindOneTexelThatDiffers) {
  for (const GeometryImage& image : images()) {
    for (const MapKind kind : {MapKind::kBaseColour, MapKind::kTangentNormal}) {
      BakedMap map = noise(kind, image);
      const Atlas atlas(image, map.layout);
      // Two texels before the border of a patch that has a neighbour there, and far from its corners.
      const std::size_t texel = atlas.texel_of({2, -2, 10}) * static_cast<std::size_t>(map.channels);
      std::swap(map.texels[texel], map.texels[texel + 2]);
      CheckReport report;
      check_gutters(map, 8, image, report);
      ASSERT_NE(report.find(kGutters), nullptr);
      EXPECT_FALSE(report.find(kGutters)->passed);
      EXPECT_NE(report.find(kGutters)->detail.find("texel (-2, 10) of patch 2"), std::string::npos)
          << report.find(kGutters)->detail;
    }
  }
}

TEST(CheckGutters, RefuseAMapOfOtherPatches) {
  CheckReport report;
  check_gutters(noise(MapKind::kOcclusion, images()[0]), 8, fixtures::sphere_image(fixtures::octahedron(), 3), report);
  ASSERT_NE(report.find(kTiles), nullptr);
  EXPECT_FALSE(report.find(kTiles)->passed);
}

TEST(CheckMips, FindOneTexelThatIsntWhatFilteringGives) {
  const fixtures::TestFolder folder;
  const GeometryImage image = fixtures::sphere_image(fixtures::icosahedron(), 3);
  const BakedMap map = as_stored(noise(MapKind::kBaseColour, image), true, 8);
  std::vector<MipLevel> mips = surface_mips(map, image.layout);
  write_geometry_image(folder / "ball.gim.exr", image);
  write_map_mips(folder / "ball.basecolor.ktx2", map, mips, 8);
  const CheckReport sound = check_file(folder / "ball.basecolor.ktx2");
  EXPECT_TRUE(sound.passed());
  ASSERT_NE(sound.find(kMips), nullptr);
  mips[1].texels[4 * 100] = 1 - mips[1].texels[4 * 100];
  write_map_mips(folder / "ball.basecolor.ktx2", map, mips, 8);
  const CheckReport broken = check_file(folder / "ball.basecolor.ktx2");
  ASSERT_NE(broken.find(kMips), nullptr);
  EXPECT_FALSE(broken.find(kMips)->passed);
  EXPECT_NE(broken.find(kMips)->detail.find("of mip 2"), std::string::npos) << broken.find(kMips)->detail;
}

TEST(CheckMips, WithoutAGeometryImageBesideAMapLooksAtItAlone) {
  const fixtures::TestFolder folder;
  const BakedMap map = noise(MapKind::kOcclusion, images()[0]);
  write_map(folder / "ball.occlusion.png", map, 8);
  const CheckReport report = check_file(folder / "ball.occlusion.png");
  EXPECT_TRUE(report.passed());
  EXPECT_EQ(report.find(kGutters), nullptr);
  ASSERT_NE(report.find("mips keep patches apart"), nullptr);
}

}  // namespace
}  // namespace lozenge
