#include "formats/patches/alike_tiles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "formats/patches/image_fixtures.h"

namespace lozenge {
namespace {

PatchLook even_look(float number) {
  PatchLook look;
  Look cell{};
  cell.fill(number);
  look.fill(cell);
  return look;
}

/// Patches of some sizes, so many of each.
MapLayout layout_of(const std::vector<std::int32_t>& counts) {
  PatchLayout patches;
  for (std::size_t k = 0; k < counts.size(); ++k) {
    patches.first_levels.insert(patches.first_levels.end(), static_cast<std::size_t>(counts[k]),
                                static_cast<std::int32_t>(k));
  }
  patches.places.resize(patches.first_levels.size());
  return make_map_layout(patches, 1024, 4);
}

std::vector<PatchLook> random_looks(const MapLayout& layout, std::mt19937& random) {
  std::uniform_real_distribution<float> number(0, 1);
  std::vector<PatchLook> looks(static_cast<std::size_t>(layout.patches()));
  for (PatchLook& look : looks) {
    for (Look& cell : look) std::generate(cell.begin(), cell.end(), [&] { return number(random); });
  }
  return looks;
}

TEST(AlikeTiles, GiveEachPatchOneOfItsSizeTheSameEachTime) {
  std::mt19937 random(1);
  for (int n = 0; n < 20; ++n) {
    std::vector<std::int32_t> counts(1 + random() % 4);
    for (std::int32_t& count : counts) count = static_cast<std::int32_t>(random() % 40);
    counts[0] = std::max(counts[0], 2);
    const MapLayout plain = layout_of(counts);
    const std::vector<PatchLook> looks = random_looks(plain, random);
    MapLayout ordered = plain;
    ordered.order = order_of_alike(plain, looks);
    std::vector<std::int32_t> tiles = ordered.order.tiles();
    for (std::int32_t p = 0; p < plain.patches(); ++p) ASSERT_EQ(ordered.tile_of(p).size, plain.tile_of(p).size);
    std::sort(tiles.begin(), tiles.end());
    for (std::int32_t t = 0; t < plain.patches(); ++t) ASSERT_EQ(tiles[t], t);
    EXPECT_EQ(order_of_alike(ordered, looks), ordered.order) << "whatever order was there before";
    EXPECT_LE(Mosaic(ordered, looks).unlikeness(), Mosaic(plain, looks).unlikeness());
  }
}

TEST(AlikeTiles, AreNoneWhereAllLookTheSame) {
  const MapLayout layout = layout_of({12, 3});
  const std::vector<PatchLook> looks(15, even_look(0.3F));
  EXPECT_FALSE(order_of_alike(layout, looks).is_given());
  EXPECT_FALSE(order_of_alike(layout_of({1}), {even_look(0.3F)}).is_given());
}

TEST(AlikeTiles, PartTwoColours) {
  // Two halves of a square of 16 x 16 tiles touch along 16 of 480 sides; at random half of the sides are such.
  std::mt19937 random(2);
  const MapLayout plain = layout_of({256});
  std::vector<PatchLook> looks(256, even_look(0));
  std::fill(looks.begin(), looks.begin() + 128, even_look(1));
  std::shuffle(looks.begin(), looks.end(), random);
  MapLayout ordered = plain;
  ordered.order = order_of_alike(plain, looks);
  EXPECT_LT(Mosaic(ordered, looks).unlikeness(), 0.12 * Mosaic(plain, looks).unlikeness());
}

TEST(AlikeTiles, MeetWithTheSidesThatLookAlike) {
  // As wholes they are all the same: halves are dark, left or right, so that wrong neighbours meet with other halves.
  std::vector<PatchLook> looks(144);
  for (std::size_t p = 0; p < looks.size(); ++p) {
    for (std::size_t c = 0; c < looks[p].size(); ++c) looks[p][c].fill((c % 4 < 2) == (p % 2 == 0) ? 1.0F : 0.0F);
  }
  const MapLayout plain = layout_of({144});
  MapLayout ordered = plain;
  ordered.order = order_of_alike(plain, looks);
  std::int32_t wrong = 0;
  for (std::int32_t p = 0; p < 144; ++p) {
    const MapTile tile = ordered.tile_of(p);
    const std::int32_t below = ordered.patch_at(tile.x, tile.y + tile.size);
    wrong += below >= 0 && p % 2 != below % 2 ? 1 : 0;
  }
  // A chess board, and rows of one kind each, are as bad; columns of one kind take turns without any cost.
  EXPECT_EQ(wrong, 0);
}

TEST(AlikeTiles, OfDifferentSizesAreComparedWhereTheyTouch) {
  std::mt19937 random(3);
  const MapLayout layout = layout_of({3, 4, 8});
  std::vector<PatchLook> looks = random_looks(layout, random);
  Mosaic mosaic(layout, looks);
  const double before = mosaic.unlikeness();
  mosaic.swap(4, 5);
  EXPECT_NE(mosaic.unlikeness(), before);
  mosaic.swap(4, 5);
  EXPECT_EQ(mosaic.unlikeness(), before);
  std::fill(looks.begin(), looks.end(), even_look(0.5F));
  EXPECT_EQ(Mosaic(layout, looks).unlikeness(), 0);
}

}  // namespace
}  // namespace lozenge
