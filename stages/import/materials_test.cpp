// The looks of an asset's materials: read whole, kept by the files of single stages, and notes where pictures can't be
// read.
#include <gtest/gtest.h>

#include <algorithm>

#include "formats/base/error.h"
#include "formats/files/source_mesh_file.h"
#include "stages/import/gltf_fixtures.h"
#include "stages/import/import.h"
#include "test_assets/documents.h"
#include "test_assets/png_writer.h"

namespace lozenge {
namespace {

using testing_gltf::json;
using testing_gltf::TestFolder;

std::string picture() {
  const auto png = test_assets::png_bytes(2, 2, 3, std::vector<std::uint8_t>(12, 200));
  return {png.begin(), png.end()};
}

/// One tetrahedron with a textured material, whose image is `image`.
json textured_document(const json& image) {
  test_assets::Document document;
  test_assets::Primitive primitive;
  primitive.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  primitive.uvs = {{0, 0}, {1, 0}, {0, 1}, {1, 1}};
  primitive.indices = {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3};
  primitive.material = 0;
  document.meshes = {{primitive}};
  document.materials = {{"paint", {0.5, 0.25, 1, 1}}};
  document.nodes.push_back({.name = "Tetrahedron", .mesh = 0});
  document.roots = {0};
  const test_assets::Encoded encoded = test_assets::encode(document);
  json root = json::parse(encoded.json);
  root["buffers"][0]["uri"] =
      "data:application/octet-stream;base64," + testing_gltf::base64({encoded.binary.begin(), encoded.binary.end()});
  root["images"] = {image};
  root["textures"] = {{{"source", 0}}};
  root["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 0}};
  return root;
}

class Materials : public testing::Test {
 protected:
  SourceMesh import(const json& document, std::uint64_t max_memory = 0) {
    fixtures::write_bytes(folder_ / "a.gltf", document.dump());
    ImportReport report;
    SourceMesh mesh = import_asset(folder_ / "a.gltf", {.max_memory = max_memory}, {}, &report);
    notes_ = report.notes;
    return mesh;
  }

  bool has_note(const std::string& text) const {
    return std::any_of(notes_.begin(), notes_.end(),
                       [&](const std::string& note) { return note.find(text) != std::string::npos; });
  }

  TestFolder folder_;
  std::vector<std::string> notes_;
};

TEST_F(Materials, ComeInWholeAndTheMeshsFileGivesThemBack) {
  const test_assets::Encoded encoded = test_assets::textured();
  test_assets::write_bytes(folder_ / "a.glb", test_assets::glb_bytes(encoded));
  const SourceMesh mesh = import_asset(folder_ / "a.glb");
  ASSERT_EQ(mesh.material_looks.size(), 3U);
  ASSERT_EQ(mesh.images.size(), 5U);
  const Material& bronze = mesh.material_looks[0];
  const TextureUse& tiles = bronze.texture(TextureRole::kBaseColour);
  EXPECT_EQ(mesh.images[tiles.image].name, "tiles");
  EXPECT_EQ(tiles.scale, Vec2d(3, 2));
  EXPECT_EQ(tiles.offset, Vec2d(0.25, 0.125));
  EXPECT_EQ(tiles.rotation, 0.5);
  EXPECT_EQ(bronze.occlusion_strength, 0.5);
  EXPECT_EQ(bronze.normal_scale, 0.75);
  EXPECT_EQ(mesh.material_looks[1].emissive_strength, 2);
  EXPECT_EQ(mesh.material_looks[2].texture(TextureRole::kBaseColour).wrap_u, Wrap::kMirror);

  write_source_mesh(folder_ / "b.glb", mesh);
  for (const SourceMesh& again : {read_source_mesh(folder_ / "b.glb"), import_asset(folder_ / "b.glb")}) {
    testing_gltf::expect_same_mesh(mesh, again);
    EXPECT_EQ(mesh.material_looks, again.material_looks);
    ASSERT_EQ(mesh.images.size(), again.images.size());
    for (std::size_t i = 0; i < mesh.images.size(); ++i) {
      EXPECT_EQ(*mesh.images[i].bytes, *again.images[i].bytes) << "unaltered";
      EXPECT_EQ(mesh.images[i].mime_type, again.images[i].mime_type);
      EXPECT_EQ(mesh.images[i].name, again.images[i].name);
    }
  }
}

TEST_F(Materials, TakeTheirPicturesFromDataUrisAndFromTheAssetsFolder) {
  fixtures::write_bytes(folder_ / "paint.png", picture());
  for (const std::string& uri :
       {std::string("paint.png"), "data:image/png;base64," + testing_gltf::base64(picture())}) {
    const SourceMesh mesh = import(textured_document({{"uri", uri}}));
    ASSERT_EQ(mesh.images.size(), 1U) << uri;
    EXPECT_EQ(std::string(mesh.images[0].bytes->begin(), mesh.images[0].bytes->end()), picture());
    EXPECT_TRUE(mesh.material_looks[0].texture(TextureRole::kBaseColour).exists());
    EXPECT_TRUE(notes_.empty());
  }
}

TEST_F(Materials, AreTheirFactorsWithANoteWhereAPictureCannotBeRead) {
  fixtures::write_bytes(folder_ / "cut.png", picture().substr(0, 40));
  std::string bomb = picture();
  bomb.replace(16, 8, std::string("\0\0\x40\0\0\0\x40\0", 8));  // 16384 x 16384
  fixtures::write_bytes(folder_ / "bomb.png", bomb);
  fixtures::write_bytes(folder_ / "words.png", "not a picture at all");
  fixtures::write_bytes(folder_ / "basis.ktx2", "\xabKTX 20\xbb\r\n\x1a\n");
  const std::vector<std::pair<std::string, std::string>> cases{{"missing.png", "no such file"},
                                                               {"../paint.png", "leaves the asset's folder"},
                                                               {"/etc/hostname", "leaves"},
                                                               {"cut.png", "ends inside of a chunk"},
                                                               {"bomb.png", "too short for 16384"},
                                                               {"words.png", "no PNG, JPEG or WebP"},
                                                               {"basis.ktx2", "KTX2"},
                                                               {"data:image/png;base64,", "image 0"},
                                                               {"https://example.org/a.png", "not a relative path"}};
  for (const auto& [uri, words] : cases) {
    const SourceMesh mesh = import(textured_document({{"uri", uri}}));
    EXPECT_TRUE(has_note(words)) << uri << ": " << (notes_.empty() ? "no note" : notes_.front());
    EXPECT_TRUE(mesh.images.empty()) << uri;
    ASSERT_EQ(mesh.material_looks.size(), 1U);
    EXPECT_FALSE(mesh.material_looks[0].texture(TextureRole::kBaseColour).exists()) << uri;
    EXPECT_EQ(mesh.material_looks[0].base_colour, Vec4d(0.5, 0.25, 1, 1));
  }
}

TEST_F(Materials, OfPicturesLargerThanTheMemoryAllowedAreRefused) {
  fixtures::write_bytes(folder_ / "large.png", picture() + std::string(4'000'000, 'x'));
  try {
    import(textured_document({{ "uri", "large.png" }}), 1'000'000);
    FAIL() << "was imported";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::kLimit) << error.what();
    EXPECT_NE(std::string(error.what()).find("large.png"), std::string::npos) << error.what();
  }
}

TEST_F(Materials, BringFactorsThatMakeNoSenseIntoTheirRange) {
  json document = textured_document({{"uri", "data:image/png;base64," + testing_gltf::base64(picture())}});
  json& material = document["materials"][0];
  material["pbrMetallicRoughness"]["metallicFactor"] = 7;
  material["pbrMetallicRoughness"]["roughnessFactor"] = -1;
  material["pbrMetallicRoughness"]["baseColorTexture"]["extensions"]["KHR_texture_transform"] = {
      {"offset", {"a", 1}}, {"scale", 3}, {"rotation", json::array()}};
  const Material look = import(document).material_looks.at(0);
  EXPECT_EQ(look.metallic, 1);
  EXPECT_EQ(look.roughness, 0);
  EXPECT_EQ(look.texture(TextureRole::kBaseColour).scale, Vec2d(1, 1));
  EXPECT_EQ(look.texture(TextureRole::kBaseColour).offset, Vec2d(0, 0));
}

TEST_F(Materials, KeepTheSetsOfTextureCoordinatesThatTheirTexturesLieBy) {
  json document = textured_document({{"uri", "data:image/png;base64," + testing_gltf::base64(picture())}});
  json& attributes = document["meshes"][0]["primitives"][0]["attributes"];
  for (const char* set : {"TEXCOORD_1", "TEXCOORD_2"}) attributes[set] = attributes["TEXCOORD_0"];
  document["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["texCoord"] = 1;
  const SourceMesh mesh = import(document);
  EXPECT_NE(find_stream(mesh.corner_attributes, kTextureCoordinates, 0), nullptr);
  EXPECT_NE(find_stream(mesh.corner_attributes, kTextureCoordinates, 1), nullptr);
  EXPECT_EQ(find_stream(mesh.corner_attributes, kTextureCoordinates, 2), nullptr);
  document["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["texCoord"] = 9;
  EXPECT_FALSE(import(document).material_looks[0].texture(TextureRole::kBaseColour).exists());
  EXPECT_TRUE(has_note("TEXCOORD_9"));
}

}  // namespace
}  // namespace lozenge
