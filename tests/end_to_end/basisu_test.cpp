// `lozenge build --texture-format basisu`: an asset more, whose textures GPUs decode.
#include <bit>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <nlohmann/json.hpp>

#include "tests/end_to_end/run_program.h"

namespace lozenge::end_to_end {
namespace {

using nlohmann::json;

constexpr int kSystem = 6;

class Basisu : public InOwnFolder<> {
 protected:
  Outcome build() const {
    return run({"build", test_asset("coated.glb"), "-o", path("out"), "--texture-format", "basisu", "--map-size", "128",
                "--no-preview", "--quiet"});
  }
};

std::uint32_t word_at(const std::string& bytes, std::size_t at) {
  std::uint32_t word = 0;
  std::memcpy(&word, &bytes.at(at + 3) - 3, 4);
  return word;
}

struct Glb {
  json document;
  std::string binary;
};

Glb parse_glb(const std::string& bytes) {
  const std::size_t length = word_at(bytes, 12);
  return {json::parse(bytes.substr(20, length)), bytes.substr(28 + length)};
}

TEST_F(Basisu, AssetsHaveTheTexturesOfTheOtherOneWithAllTheirMips) {
  const Outcome outcome = build();
  if (outcome.code == kSystem && outcome.err.find("npm") != std::string::npos) GTEST_SKIP() << outcome.err;
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const std::map<std::string, std::string> files = content_of(path("out"));
  ASSERT_TRUE(files.contains("coated.basisu.glb"));
  const Glb plain = parse_glb(files.at("coated.glb"));
  const Glb made = parse_glb(files.at("coated.basisu.glb"));
  EXPECT_EQ(made.document["meshes"], plain.document["meshes"]);
  EXPECT_EQ(made.document["materials"], plain.document["materials"]);
  EXPECT_EQ(made.document["extensionsRequired"], json({"KHR_texture_basisu"}));
  std::size_t encoded = 0;
  for (const json& texture : made.document["textures"]) {
    // The normals of coarser levels of detail are no map of the atlas.
    if (!files.contains("coated." + texture["name"].get<std::string>() + ".ktx2")) continue;
    ++encoded;
    const json& image = made.document["images"][texture["extensions"]["KHR_texture_basisu"]["source"].get<int>()];
    EXPECT_EQ(image["mimeType"], "image/ktx2");
    const json& view = made.document["bufferViews"][image["bufferView"].get<int>()];
    const std::string ktx = made.binary.substr(view.value("byteOffset", 0U), view["byteLength"].get<std::size_t>());
    EXPECT_EQ(ktx.substr(1, 6), "KTX 20");
    EXPECT_EQ(word_at(ktx, 12), 0U) << "a format that GPUs know is none of Basis Universal's";
    EXPECT_EQ(word_at(ktx, 40), std::bit_width(word_at(ktx, 20))) << "mips";
  }
  EXPECT_GE(encoded, 4U);
}

TEST_F(Basisu, WithoutNodeTheBuildSaysWhatToInstallAndWritesNothing) {
  const std::string usual = std::getenv("PATH");
  setenv("PATH", folder_.c_str(), 1);
  const Outcome outcome = build();
  setenv("PATH", usual.c_str(), 1);
  EXPECT_EQ(outcome.code, kSystem);
  EXPECT_NE(outcome.err.find("there is no program node"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("npm install"), std::string::npos) << outcome.err;
  EXPECT_TRUE(content().empty());
}

}  // namespace
}  // namespace lozenge::end_to_end
