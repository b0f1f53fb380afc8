#include "formats/files/map_mips_file.h"

#include <gtest/gtest.h>

#include <fstream>
#include <random>
#include <string>

#include "formats/base/error.h"
#include "formats/base/file_fixtures.h"
#include "formats/domain/sphere_fixtures.h"
#include "formats/files/ktx2_file.h"
#include "formats/patches/image_fixtures.h"

namespace lozenge {
namespace {

class MapMipsFile : public testing::Test {
 protected:
  fixtures::TestFolder folder_;

  void write(const std::string& bytes) const { std::ofstream(folder_ / "map.ktx2", std::ios::binary) << bytes; }
};

/// Of the six tiles of `fixtures::flat_normal_map`.
PatchLayout patches() { return fixtures::sphere_image(fixtures::tetrahedron(), 1).layout; }

/// Values that 8 bits hold exactly, so that files give back what they got.
BakedMap random_map(MapKind kind, std::int32_t channels) {
  std::mt19937 random(7);
  BakedMap map = neutral_map(kind, fixtures::flat_normal_map().layout, 0, 1, channels);
  for (std::size_t i = 0; i < map.texels.size(); ++i) {
    const auto channel = static_cast<std::int32_t>(i % static_cast<std::size_t>(channels));
    map.texels[i] =
        static_cast<float>(value_of_share(traits_of(kind), channel, static_cast<double>(random() % 256) / 255));
  }
  return map;
}

TEST_F(MapMipsFile, GivesBackEveryLevel) {
  for (const MapTraits& traits : kMapKinds) {
    if (!fits_integers(traits)) continue;
    for (const int bits : {8, 16}) {
      if (bits == 16 && traits.values != MapValues::kDirections) continue;
      const BakedMap map = random_map(traits.kind, traits.channels);
      const std::vector<MipLevel> mips = surface_mips(map, patches());
      write_map_mips(folder_ / "map.ktx2", map, mips, bits);
      const MapMips read = read_map_mips(folder_ / "map.ktx2");
      EXPECT_EQ(read.bits, bits);
      EXPECT_EQ(read.map.kind, map.kind);
      EXPECT_EQ(read.map.layout, map.layout);
      ASSERT_EQ(read.map.texels.size(), map.texels.size());
      const double half_step = 0.5 / ((1 << bits) - 1) + 1e-7;
      const auto expect_near = [&](const std::vector<float>& found, const std::vector<float>& expected) {
        ASSERT_EQ(found.size(), expected.size());
        for (std::size_t i = 0; i < found.size(); ++i) {
          const auto channel = static_cast<std::int32_t>(i % static_cast<std::size_t>(map.channels));
          ASSERT_NEAR(stored_share(traits, channel, found[i]), stored_share(traits, channel, expected[i]), half_step);
        }
      };
      expect_near(read.map.texels, map.texels);
      ASSERT_EQ(read.mips.size(), mips.size());
      for (std::size_t l = 0; l < mips.size(); ++l) expect_near(read.mips[l].texels, mips[l].texels);
    }
  }
}

TEST_F(MapMipsFile, OfColoursWithoutAlphaIsOpaque) {
  const BakedMap map = random_map(MapKind::kBaseColour, 3);
  write_map_mips(folder_ / "map.ktx2", map, surface_mips(map, patches()), 8);
  const MapMips read = read_map_mips(folder_ / "map.ktx2");
  ASSERT_EQ(read.map.channels, 4);
  for (std::size_t i = 3; i < read.map.texels.size(); i += 4) EXPECT_EQ(read.map.texels[i], 1.0F);
}

TEST_F(MapMipsFile, HasTheSameBytesEachTime) {
  const BakedMap map = random_map(MapKind::kBaseColour, 4);
  const std::vector<MipLevel> mips = surface_mips(map, patches());
  write_map_mips(folder_ / "a.ktx2", map, mips, 8);
  write_map_mips(folder_ / "b.ktx2", map, mips, 8);
  EXPECT_EQ(fixtures::bytes_of(folder_ / "a.ktx2"), fixtures::bytes_of(folder_ / "b.ktx2"));
}

TEST_F(MapMipsFile, CutOffAnywhereIsRefused) {
  const BakedMap map = random_map(MapKind::kBaseColour, 4);
  write_map_mips(folder_ / "whole.ktx2", map, surface_mips(map, patches()), 8);
  const std::string whole = fixtures::bytes_of(folder_ / "whole.ktx2");
  for (std::size_t size = 0; size < whole.size(); size += size < 400 ? 1 : 37) {
    write(whole.substr(0, size));
    EXPECT_THROW(read_map_mips(folder_ / "map.ktx2"), Error) << size;
  }
}

TEST_F(MapMipsFile, ThatContradictsItselfIsRefused) {
  const BakedMap map = random_map(MapKind::kBaseColour, 4);
  write_map_mips(folder_ / "whole.ktx2", map, surface_mips(map, patches()), 8);
  const std::string whole = fixtures::bytes_of(folder_ / "whole.ktx2");
  // The identifier, the header but for what follows from it, each level's size, the descriptor.
  for (const std::size_t at : {3U, 12U, 16U, 20U, 23U, 24U, 28U, 32U, 36U, 40U, 44U, 96U, 120U, 216U, 224U, 240U}) {
    std::string changed = whole;
    changed[at] = static_cast<char>(changed[at] ^ 0x41);
    write(changed);
    EXPECT_THROW(read_map_mips(folder_ / "map.ktx2"), Error) << at;
  }
}

TEST_F(MapMipsFile, OfAnotherPictureIsRefused) {
  const Ktx2Texture texture{TexelFormat::kR8, 2, 2, {{1, 2, 3, 4}, {5}}, "a picture"};
  const std::vector<std::uint8_t> bytes = ktx2_of(texture);
  write(std::string(bytes.begin(), bytes.end()));
  EXPECT_EQ(read_ktx2(folder_ / "map.ktx2", 16).levels, texture.levels);
  EXPECT_EQ(read_ktx2(folder_ / "map.ktx2", 16).description, texture.description);
  EXPECT_THROW(read_ktx2(folder_ / "map.ktx2", 1), Error);
  EXPECT_THROW(read_map_mips(folder_ / "map.ktx2"), Error);
}

}  // namespace
}  // namespace lozenge
