#include "formats/files/picture_check.h"

#include <gtest/gtest.h>

#include <cstring>
#include <sstream>

#include "formats/base/file_fixtures.h"
#include "formats/domain/sphere_fixtures.h"
#include "formats/files/baked_maps_file.h"
#include "formats/files/geometry_image_file.h"
#include "formats/files/patch_set_file.h"
#include "formats/patches/image_fixtures.h"

namespace lozenge {
namespace {

using fixtures::bytes_of;
using fixtures::TestFolder;

std::optional<std::string> defect_of(const std::string& bytes) {
  std::istringstream in(bytes);
  return find_picture_defect(in, bytes.size());
}

template <typename T>
std::string raw(T value) {
  return {reinterpret_cast<const char*>(&value), sizeof(T)};
}

std::string joined(std::initializer_list<std::string> pieces) {
  std::string whole;
  for (const std::string& piece : pieces) whole.append(piece);
  return whole;
}

const std::string kZero(1, '\0');

std::string attribute(const std::string& name, const std::string& type, const std::string& bytes) {
  return joined({name, kZero, type, kZero, raw(static_cast<std::int32_t>(bytes.size())), bytes});
}

/// An attribute that says how long it is, and ends at once.
std::string claim(std::int32_t size) { return joined({"a", kZero, "string", kZero, raw(size), "short"}); }

std::string window(std::int32_t width, std::int32_t height) {
  return attribute("dataWindow", "box2i", joined({raw(0), raw(0), raw(width - 1), raw(height - 1)}));
}

std::string tiles(std::uint32_t width, std::uint32_t height) {
  return attribute("tiles", "tiledesc", joined({raw(width), raw(height), kZero}));
}

/// The start of an EXR of one part, with some bytes of content.
std::string exr(const std::string& attributes) {
  return joined({raw(20000630), raw(2), attributes, kZero, std::string(100, 'x')});
}

TEST(PictureCheck, FindsNothingWrongInWhatLozengeWrites) {
  const TestFolder folder;
  write_geometry_image(folder / "a.gim.exr", fixtures::sphere_image(fixtures::icosahedron(), 3));
  write_patch_set(folder / "a.exr", fixtures::sphere_patches(fixtures::tetrahedron(), 2));
  write_map(folder / "a.png", fixtures::flat_normal_map(), 16);
  write_map(folder / "b.exr", fixtures::flat_normal_map(), 32);
  for (const char* name : {"a.gim.exr", "a.exr", "a.png", "b.exr"}) {
    EXPECT_EQ(find_picture_defect(folder / name), std::nullopt) << name;
  }
  EXPECT_EQ(find_picture_defect(folder / "nothing.exr"), std::nullopt);
  EXPECT_EQ(defect_of("neither of the two"), std::nullopt);
}

TEST(PictureCheck, FindsEveryCutThroughAHeader) {
  const TestFolder folder;
  write_geometry_image(folder / "a.gim.exr", fixtures::sphere_image(fixtures::tetrahedron(), 1));
  const std::string whole = bytes_of(folder / "a.gim.exr");
  // The last header ends with its last attribute's bytes, and a zero after them.
  const std::size_t end = whole.rfind("lozenge.level");
  for (std::size_t length = 4; length < end; ++length) EXPECT_NE(defect_of(whole.substr(0, length)), std::nullopt);
}

TEST(PictureCheck, FindsSizesThatNoFileOfThatLengthCanHave) {
  EXPECT_EQ(defect_of(exr(window(100, 100))), std::nullopt);
  EXPECT_EQ(defect_of(exr(joined({window(100, 100), tiles(64, 64)}))), std::nullopt);
  for (const std::string& attributes :
       {claim(1'000'000), claim(-1), window(1'000'000'000, 1), window(1, 1'000'000'000),
        joined({window(1'000'000, 1'000'000), tiles(1, 1)}), joined({window(10, 10), tiles(100'000, 100'000)}),
        joined({window(10, 10), tiles(0, 1)}), attribute("words", "stringvector", raw(1'000'000'000)),
        attribute("preview", "preview", joined({raw(65536), raw(65536)})), std::string(300, 'n')}) {
    EXPECT_NE(defect_of(exr(attributes)), std::nullopt) << attributes;
  }
}

TEST(PictureCheck, FindsAttributesThatAreNotAsLongAsTheirTypeIs) {
  EXPECT_EQ(defect_of(exr(attribute("a", "int", "1234"))), std::nullopt);
  EXPECT_EQ(defect_of(exr(attribute("a", "unheard of", "12345"))), std::nullopt);
  for (const std::string& attributes :
       {attribute("a", "int", "12345"), attribute("a", "v3f", ""), attribute("a", "floatvector", "123"),
        attribute("dataWindow", "box2i", "short"), attribute("tiles", "tiledesc", ""),
        attribute("a", "stringvector", "abc"), attribute("channels", "chlist", "R"),
        attribute("channels", "chlist", joined({"R", kZero})),
        attribute("channels", "chlist", joined({kZero, kZero}))}) {
    EXPECT_NE(defect_of(exr(attributes)), std::nullopt) << attributes;
  }
}

TEST(PictureCheck, FindsChunksThatEndPastTheFile) {
  const std::string png = "\x89PNG\r\n\x1a\n";
  EXPECT_NE(defect_of(joined({png, "\x7F\xFF\xFF\xFFtEXtabcd"})), std::nullopt);
  EXPECT_NE(defect_of(joined({png, "abc"})), std::nullopt);
  const std::string text("\0\0\0\2tEXtabcrc1", 14);
  const std::string end("\0\0\0\0IENDcrc2", 12);
  EXPECT_EQ(defect_of(joined({png, text, end})), std::nullopt);
}

}  // namespace
}  // namespace lozenge
