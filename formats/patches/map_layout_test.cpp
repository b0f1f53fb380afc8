#include "formats/patches/map_layout.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "formats/base/error.h"
#include "formats/patches/image_fixtures.h"

namespace lozenge {
namespace {

/// So many patches of each first level, from 0 up.
PatchLayout patches_of(const std::vector<std::int32_t>& counts) {
  PatchLayout layout;
  for (std::size_t k = 0; k < counts.size(); ++k) {
    layout.first_levels.insert(layout.first_levels.end(), static_cast<std::size_t>(counts[k]),
                               static_cast<std::int32_t>(k));
  }
  layout.places.resize(layout.first_levels.size());
  return layout;
}

std::vector<PatchLayout> random_patches() {
  std::mt19937 random(5);
  std::vector<PatchLayout> all;
  for (int n = 0; n < 200; ++n) {
    std::vector<std::int32_t> counts(1 + random() % 6);
    for (std::int32_t& count : counts) count = static_cast<std::int32_t>(random() % (1U << (random() % 9)));
    counts[0] = std::max(counts[0], 1);
    all.push_back(patches_of(counts));
  }
  return all;
}

TEST(MapLayout, GivesEveryPatchATileOfItsOwn) {
  for (const PatchLayout& patches : random_patches()) {
    const MapLayout layout = make_map_layout(patches, 1024, 4);
    ASSERT_EQ(layout.patches(), patches.size());
    ASSERT_TRUE(layout.fits(patches));
    std::vector<std::int32_t> owners(static_cast<std::size_t>(layout.width) * layout.height, -1);
    for (std::int32_t p = 0; p < patches.size(); ++p) {
      const MapTile tile = layout.tile_of(p);
      ASSERT_GE(std::min(tile.x, tile.y), 0);
      ASSERT_LE(std::max(tile.x, tile.y) + tile.size, 1024);
      for (std::int32_t y = tile.y; y < tile.y + tile.size; ++y) {
        for (std::int32_t x = tile.x; x < tile.x + tile.size; ++x) {
          std::int32_t& owner = owners[static_cast<std::size_t>(y) * layout.width + x];
          ASSERT_EQ(owner, -1) << "patches " << owner << " and " << p;
          owner = p;
        }
      }
    }
    for (std::int32_t y = 0; y < layout.height; ++y) {
      for (std::int32_t x = 0; x < layout.width; ++x) {
        ASSERT_EQ(layout.patch_at(x, y), owners[static_cast<std::size_t>(y) * layout.width + x]);
      }
    }
  }
}

TEST(MapLayout, FindsPatchesInTheTilesThatAnOrderGivesThem) {
  std::mt19937 random(6);
  for (const PatchLayout& patches : random_patches()) {
    const MapLayout plain = make_map_layout(patches, 1024, 4);
    MapLayout ordered = plain;
    ordered.order = fixtures::random_order(plain, random);
    ASSERT_TRUE(ordered.fits(patches));
    for (std::int32_t p = 0; p < patches.size(); ++p) {
      const MapTile tile = ordered.tile_of(p);
      ASSERT_EQ(tile.size, plain.tile_of(p).size);
      ASSERT_EQ(ordered.patch_at(tile.x, tile.y), p);
      ASSERT_EQ(ordered.patch_at(tile.x + tile.size - 1, tile.y + tile.size - 1), p);
    }
  }
}

TEST(MapLayout, HalvesATileForEachLevelThatAPatchBeginsLater) {
  for (const PatchLayout& patches : random_patches()) {
    const MapLayout layout = make_map_layout(patches, 4096, 4);
    for (std::int32_t p = 0; p < patches.size(); ++p) {
      const MapTile tile = layout.tile_of(p);
      EXPECT_EQ(tile.size, std::max(layout.tile >> patches.first_level(p), layout.smallest_tile()));
      EXPECT_EQ(tile.gutter, std::min(4, std::max(tile.size / 8, 1)));
      EXPECT_GE(tile.inner(), 4);
    }
  }
}

TEST(MapLayout, BeginsNoTexelOfAMipAcrossTwoTiles) {
  for (const PatchLayout& patches : random_patches()) {
    const MapLayout layout = make_map_layout(patches, 2048, 4);
    for (std::int32_t p = 0; p < patches.size(); ++p) {
      const MapTile tile = layout.tile_of(p);
      EXPECT_EQ(tile.x % 8 + tile.y % 8 + tile.size % 8, 0) << p;
    }
  }
}

TEST(MapLayout, MixesNoTwoTilesInMipsThatGuttersAreWideEnoughFor) {
  for (const PatchLayout& patches : random_patches()) {
    for (const std::int32_t gutter : {0, 1, 2, 3, 4, 5, 8, 16, 31}) {
      const MapLayout layout = make_map_layout(patches, 4096, gutter);
      for (std::int32_t p = 0; p < patches.size(); ++p) {
        const MapTile tile = layout.tile_of(p);
        const auto mips = static_cast<std::int32_t>(std::floor(std::log2(2 * tile.gutter + 1)));
        ASSERT_TRUE(layout.keeps_apart(tile.size, 1 << mips)) << p;
        ASSERT_FALSE(layout.keeps_apart(tile.size, 2 << mips)) << p;
        ASSERT_LE(layout.clean_mips(), mips);
        // A texel of the mip averages texels of this tile alone, and so does the next, with which a look-up at the
        // border blends it.
        const std::int32_t texel = 1 << mips;
        ASSERT_EQ(tile.x % texel + tile.y % texel + tile.size % texel, 0) << p;
        const Vec2d first = layout.texcoord(p, 0, 1);
        const Vec2d last = layout.texcoord(p, 1, 0);
        for (const double border : {first.x, last.y, last.x, first.y}) {
          const double at = border * layout.width / texel - 0.5;
          const bool across = border == first.x || border == last.x;
          const std::int32_t begin = (across ? tile.x : tile.y) / texel;
          ASSERT_GE(std::floor(at + 1e-9), begin) << p << " at gutter " << gutter;
          ASSERT_LE(std::ceil(at - 1e-9), begin + tile.size / texel - 1) << p << " at gutter " << gutter;
        }
      }
    }
  }
}

TEST(MapLayout, LeavesSevenTenthsOfTheTilesToThePatches) {
  // Up to as many patches as an atlas of 2048 texels has tiles of 56 for, ten times those of the domains that are
  // chosen without being asked.
  for (std::int32_t count = 1; count <= 1296; ++count) {
    const MapLayout layout = make_map_layout(fixtures::patches_of_one_scale(count), 2048, 4);
    EXPECT_GE(layout.inner() * layout.inner(), 0.7 * layout.tile * layout.tile) << count;
  }
}

TEST(MapLayout, HoldsAsManyTexelsAsFit) {
  for (std::int32_t count = 1; count < 400; ++count) {
    const MapLayout layout = make_map_layout(fixtures::patches_of_one_scale(count), 1024, 4);
    const std::int32_t columns = layout.columns;
    EXPECT_LE(columns * layout.tile, 1024);
    EXPECT_GT(columns * (layout.tile + 8), 1024);
    EXPECT_GE(columns * columns, count);
    EXPECT_LT((columns - 1) * (columns - 1), count);
    const Vec2d corner = layout.texcoord(count - 1, 1, 1);
    EXPECT_LT(corner.x, 1);
    EXPECT_LT(corner.y, 1);
  }
}

TEST(MapLayout, TooSmallForItsPatchesIsRefused) {
  const auto alike = fixtures::patches_of_one_scale;
  EXPECT_THROW(make_map_layout(alike(400), 100, 4), Error);
  EXPECT_THROW(make_map_layout(alike(1), 5, 1), Error);
  EXPECT_THROW(make_map_layout(alike(16), 0, 0), Error);
  EXPECT_THROW(make_map_layout(alike(16), kMostMapSize + 1, 0), Error);
  EXPECT_THROW(make_map_layout(alike(16), 64, -1), Error);
  EXPECT_NO_THROW(make_map_layout(alike(400), 120, 4));
}

TEST(MapLayout, NeedsTheSizeThatIsSaidToBeTheLeast) {
  for (const PatchLayout& patches : random_patches()) {
    const auto least = static_cast<std::int32_t>(least_map_size(patches));
    EXPECT_NO_THROW(make_map_layout(patches, least, 4));
    EXPECT_THROW(make_map_layout(patches, least - 1, 4), Error);
  }
}

TEST(MapLayout, GrowsByItselfWhereTilesWouldBeSmall) {
  EXPECT_EQ(default_map_size(fixtures::patches_of_one_scale(225)), 2048);
  EXPECT_EQ(default_map_size(fixtures::patches_of_one_scale(16'384)), 2048);
  EXPECT_EQ(default_map_size(fixtures::patches_of_one_scale(30'000)), 4096);
  EXPECT_EQ(default_map_size(fixtures::patches_of_one_scale(2'000'000)), 16384);
}

TEST(MapLayout, WidensGuttersOfLargeTilesByItself) {
  for (std::int32_t count = 1; count < 2000; count += 1 + count / 10) {
    const PatchLayout patches = fixtures::patches_of_one_scale(count);
    for (const std::int32_t size : {512, 2048, 4096}) {
      const std::int32_t gutter = default_gutter(patches, size);
      EXPECT_GE(gutter, std::max(4, size / 512)) << count;
      if (gutter == std::max(4, size / 512)) continue;
      const MapLayout layout = make_map_layout(patches, size, gutter);
      EXPECT_GE(3 * layout.inner() * layout.inner(), 2 * layout.tile * layout.tile) << count;
      EXPECT_GE(layout.clean_mips(), 4) << count;
    }
  }
  EXPECT_EQ(default_gutter(fixtures::patches_of_one_scale(127), 2048), 8);
  EXPECT_EQ(default_gutter(fixtures::patches_of_one_scale(225), 2048), 4);
  EXPECT_EQ(default_gutter(fixtures::patches_of_one_scale(2000), 2048), 4);
}

TEST(MapLayout, FitsNoOtherPatches) {
  const MapLayout layout = make_map_layout(patches_of({10, 4, 8}), 1024, 2);
  EXPECT_TRUE(layout.fits(patches_of({10, 4, 8})));
  EXPECT_FALSE(layout.fits(patches_of({10, 4, 9})));
  EXPECT_FALSE(layout.fits(patches_of({10, 5, 8})));
  EXPECT_FALSE(make_map_layout(patches_of({10}), 1024, 2).fits(patches_of({11})));
}

}  // namespace
}  // namespace lozenge
