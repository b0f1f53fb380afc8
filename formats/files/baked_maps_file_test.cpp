#include "formats/files/baked_maps_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <fstream>
#include <random>
#include <string>
#include <tuple>

#include "formats/base/error.h"
#include "formats/base/file_fixtures.h"
#include "formats/patches/image_fixtures.h"

namespace lozenge {
namespace {

namespace fs = std::filesystem;
using std::string_literals::operator""s;

class MapFile : public testing::Test {
 protected:
  fs::path file(const std::string& name) const { return folder_ / name; }
  std::string bytes_of(const std::string& name) const { return fixtures::bytes_of(file(name)); }
  void put(const std::string& name, const std::string& bytes) const {
    std::ofstream(file(name), std::ios::binary) << bytes;
  }
  ExitCode refusal(const std::string& name) const {
    try {
      read_map(file(name));
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(name), std::string::npos) << "the message names the file";
      return error.code();
    }
    return ExitCode::kDone;
  }

 private:
  fixtures::TestFolder folder_;
};

BakedMap random_map(MapKind kind, std::int32_t size, std::int32_t shrink, unsigned seed) {
  BakedMap map;
  map.kind = kind;
  map.layout = make_map_layout(fixtures::patches_of_one_scale(6), size, 2);
  map.channels = kind == MapKind::kOcclusion ? 1 : 3;
  map.shrink = shrink;
  map.level = 1;
  map.texels.resize(static_cast<std::size_t>(map.width()) * map.height() * map.channels);
  std::mt19937 random(seed);
  const double low = kind == MapKind::kOcclusion ? 0 : -1;
  std::uniform_real_distribution<double> number(low, 1);
  for (float& value : map.texels) value = static_cast<float>(number(random) * (kind == MapKind::kPosition ? 100 : 1));
  return map;
}

void expect_same_head(const BakedMap& a, const BakedMap& b) {
  EXPECT_EQ(a.kind, b.kind);
  EXPECT_EQ(a.channels, b.channels);
  EXPECT_EQ(a.shrink, b.shrink);
  EXPECT_EQ(a.level, b.level);
  EXPECT_EQ(a.layout, b.layout);
}

TEST_F(MapFile, GivesBackTheMapToHalfAStep) {
  for (const MapKind kind : {MapKind::kTangentNormal, MapKind::kObjectNormal, MapKind::kOcclusion}) {
    for (const int bits : {8, 16}) {
      const BakedMap map = random_map(kind, 64, kind == MapKind::kOcclusion ? 4 : 1, 1);
      write_map(file("map.png"), map, bits);
      const BakedMap back = read_map(file("map.png"));
      expect_same_head(map, back);
      ASSERT_EQ(map.texels.size(), back.texels.size());
      const double range = kind == MapKind::kOcclusion ? 1 : 2;
      const double half_step = 0.5 * range / (std::exp2(bits) - 1) + 1e-6;
      for (std::size_t i = 0; i < map.texels.size(); ++i) EXPECT_NEAR(map.texels[i], back.texels[i], half_step);
    }
  }
}

TEST_F(MapFile, OfFloatsGivesBackTheSameBits) {
  for (const MapKind kind : {MapKind::kObjectNormal, MapKind::kOcclusion, MapKind::kPosition}) {
    const BakedMap map = random_map(kind, 48, 1, 2);
    write_map(file("map.exr"), map, 32);
    const BakedMap back = read_map(file("map.exr"));
    expect_same_head(map, back);
    EXPECT_EQ(map.texels, back.texels);
  }
}

TEST_F(MapFile, ReadAndWrittenAgainHasTheSameBytes) {
  for (const std::string name : {"8.png", "16.png", "16.exr", "32.exr"}) {
    const int bits = std::stoi(name);
    write_map(file(name), random_map(MapKind::kTangentNormal, 64, 1, 3), bits);
    const std::string first = bytes_of(name);
    write_map(file(name), read_map(file(name)), bits);
    EXPECT_EQ(first, bytes_of(name)) << name;
  }
}

TEST_F(MapFile, AsStoredIsWhatIsReadAgain) {
  for (const auto& [kind, name, bits] : {std::tuple(MapKind::kTangentNormal, "a.png", 8),
                                         {MapKind::kOcclusion, "b.png", 8},
                                         {MapKind::kObjectNormal, "c.png", 16},
                                         {MapKind::kPosition, "d.exr", 32}}) {
    const BakedMap map = random_map(kind, 64, 1, 7);
    const BakedMap stored = as_stored(map, kind != MapKind::kPosition, bits);
    write_map(file(name), map, bits);
    const BakedMap read = read_map(file(name));
    expect_same_head(stored, read);
    EXPECT_EQ(stored.texels, read.texels);
    write_map(file("again"s + name), stored, bits);
    EXPECT_EQ(bytes_of("again"s + name), bytes_of(name)) << "from the bytes that it brings along";
  }
}

TEST_F(MapFile, TellsWhatIsNoMapBecauseItIsTheSameEverywhere) {
  BakedMap map = random_map(MapKind::kTangentNormal, 32, 1, 8);
  map.constants = {{MapKind::kBaseColour, {0.1F, 1.0F / 3, 1, 0.5F}}, {MapKind::kEmissive, {0, 1e-7F, 1, 1}}};
  for (const std::string name : {"map.png", "map.exr"}) {
    write_map(file(name), map, name == "map.png" ? 8 : 32);
    EXPECT_EQ(read_map(file(name)).constants, map.constants) << "to the last bit";
  }
  std::string bytes = bytes_of("map.exr");
  const std::size_t at = bytes.find("constant-emissive=0/1e-07");
  ASSERT_NE(at, std::string::npos);
  bytes[at + std::string("constant-emissive=").size()] = '7';
  put("wrong.exr", bytes);
  EXPECT_EQ(refusal("wrong.exr"), ExitCode::kUnusableInput) << "shares end at 1";
}

TEST_F(MapFile, MayHaveNormalsWithYDownAndGivesThemBackWithYUp) {
  const BakedMap map = random_map(MapKind::kTangentNormal, 32, 1, 9);
  for (const auto& [name, bits] : {std::pair("8.png", 8), {"16.png", 16}, {"32.exr", 32}}) {
    const bool is_png = bits != 32;
    const BakedMap up = as_stored(map, is_png, bits);
    const BakedMap stored = as_stored(map, is_png, bits, NormalY::kDown);
    write_map(file(name), stored, bits, NormalY::kDown);
    const BakedMap read = read_map(file(name));
    EXPECT_EQ(read.texels, stored.texels) << name;
    ASSERT_EQ(read.texels.size(), up.texels.size());
    for (std::size_t i = 0; i < read.texels.size(); ++i) ASSERT_NEAR(read.texels[i], up.texels[i], 2.0 / 255 + 1e-6);
    write_map(file("again"s + name), map, bits, NormalY::kDown);
    EXPECT_EQ(bytes_of("again"s + name), bytes_of(name));
    write_map(file("up"s + name), map, bits);
    EXPECT_NE(bytes_of("up"s + name), bytes_of(name));
  }
  const BakedMap occlusion = random_map(MapKind::kOcclusion, 32, 1, 9);
  EXPECT_EQ(png_of(occlusion, 8, NormalY::kDown), png_of(occlusion, 8)) << "no normals";
}

TEST_F(MapFile, EmbeddedIsTheSameAsTheFile) {
  const BakedMap map = random_map(MapKind::kTangentNormal, 32, 1, 4);
  write_map(file("map.png"), map, 8);
  const std::vector<std::uint8_t> bytes = png_of(map, 8);
  EXPECT_EQ(bytes_of("map.png"), std::string(bytes.begin(), bytes.end()));
}

TEST_F(MapFile, HoldsNoColourSpaceThatAnEngineWouldApply) {
  write_map(file("map.png"), random_map(MapKind::kTangentNormal, 32, 1, 5), 8);
  const std::string bytes = bytes_of("map.png");
  for (const char* chunk : {"gAMA", "sRGB", "iCCP", "cHRM", "pHYs", "tIME"}) {
    EXPECT_EQ(bytes.find(chunk), std::string::npos) << chunk;
  }
}

TEST_F(MapFile, WrittenWithOptionsThatAFormatDoesNotHaveIsRefusedAndLeavesNothing) {
  const BakedMap normal = random_map(MapKind::kTangentNormal, 32, 1, 6);
  const BakedMap position = random_map(MapKind::kPosition, 32, 1, 6);
  EXPECT_THROW(write_map(file("a.png"), normal, 32), Error);
  EXPECT_THROW(write_map(file("a.exr"), normal, 8), Error);
  EXPECT_THROW(write_map(file("a.jpg"), normal, 8), Error);
  EXPECT_THROW(write_map(file("a.png"), position, 16), Error);
  EXPECT_THROW(write_map(file("no/folder/a.png"), normal, 8), Error);
  EXPECT_TRUE(fs::is_empty(file("")));
}

TEST_F(MapFile, TruncatedAnywhereIsRefused) {
  for (const std::string name : {"8.png", "32.exr"}) {
    write_map(file(name), random_map(MapKind::kObjectNormal, 40, 1, 7), std::stoi(name));
    const std::string whole = bytes_of(name);
    for (std::size_t size = 0; size + 20 < whole.size(); size += whole.size() / 23 + 1) {
      put(name, whole.substr(0, size));
      EXPECT_EQ(refusal(name), ExitCode::kUnusableInput) << name << " cut to " << size;
    }
  }
}

TEST_F(MapFile, WithADescriptionThatContradictsItIsRefused) {
  write_map(file("map.exr"), random_map(MapKind::kObjectNormal, 40, 1, 8), 32);
  const std::string whole = bytes_of("map.exr");
  const auto with = [&](const std::string& from, const std::string& to) {
    ASSERT_EQ(from.size(), to.size());
    std::string changed = whole;
    const std::size_t at = changed.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    put("map.exr", changed.replace(at, from.size(), to));
    EXPECT_EQ(refusal("map.exr"), ExitCode::kUnusableInput) << to;
  };
  with("lozenge object", "someone object");
  with("object-normal", "object-colour");
  with("columns=3", "columns=9");
  with("columns=3", "columns=x");
  with("columns=3", "columns=0");
  with("tile=8", "tile=x");
  with("tile=8", "tile=0");
  with("gutter=2", "gutter=x");
  with("tiles0=6", "tiles0=7");
  with("tiles0=6", "tiles0=0");
  with("tiles3=0", "tiles3=9");
  with("shrink=1", "shrink=0");
  with("level=1", "level=-");
}

TEST_F(MapFile, OfTheFirstVersionHasTilesOfOneSize) {
  write_map(file("map.exr"), random_map(MapKind::kObjectNormal, 40, 1, 8), 32);
  std::string old = bytes_of("map.exr");
  const std::string counts = " tiles0=6 tiles1=0 tiles2=0 tiles3=0 tiles4=0 tiles5=0";
  ASSERT_NE(old.find(counts), std::string::npos);
  put("map.exr", old.replace(old.find(counts), counts.size(), std::string(counts.size(), ' ')));
  EXPECT_EQ(read_map(file("map.exr")).layout, make_map_layout(fixtures::patches_of_one_scale(6), 40, 2));
}

TEST_F(MapFile, KeepsTheSizesOfTiles) {
  BakedMap map = random_map(MapKind::kObjectNormal, 256, 1, 9);
  PatchLayout patches = fixtures::patches_of_one_scale(12);
  patches.first_levels = {0, 0, 0, 1, 1, 1, 1, 1, 2, 2, 2, 2};
  map.layout = make_map_layout(patches, 256, 2);
  write_map(file("map.png"), map, 8);
  EXPECT_EQ(read_map(file("map.png")).layout, map.layout);
}

TEST_F(MapFile, KeepsTheOrderOfTilesAndRefusesWhatIsNone) {
  BakedMap map = random_map(MapKind::kObjectNormal, 256, 1, 9);
  PatchLayout patches = fixtures::patches_of_one_scale(12);
  patches.first_levels = {0, 0, 0, 1, 1, 1, 1, 1, 2, 2, 2, 2};
  map.layout = make_map_layout(patches, 256, 2);
  map.layout.order = TileOrder({1, 2, 0, 4, 3, 5, 7, 6, 9, 8, 11, 10});
  for (const char* const name : {"map.png", "map.exr"}) {
    write_map(file(name), map, name == std::string("map.png") ? 8 : 32);
    EXPECT_EQ(read_map(file(name)).layout, map.layout);
  }
  const std::string whole = bytes_of("map.exr");
  const std::string order = " order=1,2,0,4,3,5,7,6,9,8,11,10";
  for (const std::string wrong :
       {" order=1,2,0,4,4,5,7,6,9,8,11,10", " order=1,2,4,0,3,5,7,6,9,8,11,10", " order=1,2,0,4,3,5,7,6,9,8,11,12",
        " order=1,2,-,4,3,5,7,6,9,8,11,10", " order=1,2,0,4,3,5,7,6,9,8,11   ", " order=1,2,0,4,3,5,7,6,9,8,11,,,",
        " order=1,2,0,4,3,5,7,6,9,8,11101", " order=                         "}) {
    std::string changed = whole;
    ASSERT_NE(changed.find(order), std::string::npos);
    put("map.exr", changed.replace(changed.find(order), order.size(), wrong));
    EXPECT_EQ(refusal("map.exr"), ExitCode::kUnusableInput) << wrong;
  }
}

TEST_F(MapFile, ThatIsNoPictureIsRefused) {
  put("map.png", "not a picture at all");
  EXPECT_EQ(refusal("map.png"), ExitCode::kUnusableInput);
  EXPECT_EQ(refusal("missing.png"), ExitCode::kUnusableInput);
}

}  // namespace
}  // namespace lozenge
