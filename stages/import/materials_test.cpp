// The looks of an asset's materials: read whole, kept by the files of single stages, and notes where pictures can't be
// read.
#include <gtest/gtest.h>

#include <algorithm>

#include "formats/base/error.h"
#include "formats/files/readers/gltf/buffers.h"
#include "formats/files/source_mesh_file.h"
#include "formats/surface/extension_textures.h"
#include "stages/import/gltf_fixtures.h"
#include "stages/import/import.h"
#include "stages/import/import_surface.h"

namespace lozenge {
namespace {

using testing_gltf::json;
using testing_gltf::TestFolder;

/// A PNG of 2 x 2 pixels.
std::string picture_uri() {
  return "data:image/"
         "png;base64,iVBORw0KGgoAAAANSUhEUgAAAAIAAAACCAIAAAD91JpzAAAAD0lEQVR4nGM4AQYMUWAAADioBs3w9rF5AAAAAElFTkSuQmCC";
}
std::string picture() {
  const std::vector<unsigned char> bytes = decode_data_uri(picture_uri());
  return {bytes.begin(), bytes.end()};
}

/// One tetrahedron with a textured material, whose image is `image`.
json textured_document(const json& image) {
  testing_gltf::TestGltf gltf = testing_gltf::tetrahedron();
  const int uv = gltf.add_values(std::vector<float>{0, 0, 1, 0, 0, 1, 1, 1}, "VEC2", testing_gltf::kFloat);
  json root = json::parse(gltf.gltf(gltf.data_uri()));
  json& primitive = root["meshes"][0]["primitives"][0];
  primitive["attributes"]["TEXCOORD_0"] = uv;
  primitive["material"] = 0;
  root["images"] = json::array({image});
  root["textures"] = json::array({{{"source", 0}}});
  root["materials"] = json::array(
      {{{"name", "paint"},
        {"pbrMetallicRoughness", {{"baseColorFactor", {0.5, 0.25, 1, 1}}, {"baseColorTexture", {{"index", 0}}}}}}});
  return root;
}

/// With everything that the core material has, and the textures of extensions.
json whole_document() {
  json root = textured_document({{"uri", picture_uri()}, {"name", "tiles"}});
  root["images"].push_back({{"uri", picture_uri()}, {"name", "rest"}});
  root["samplers"] = json::array({{{"wrapS", 33648}, {"wrapT", 33071}, {"magFilter", 9728}}});
  root["textures"][0]["sampler"] = 0;
  root["textures"].push_back({{"source", 1}});
  json& material = root["materials"][0];
  material["pbrMetallicRoughness"]["baseColorTexture"]["extensions"]["KHR_texture_transform"] = {
      {"offset", {0.25, 0.125}}, {"rotation", 0.5}, {"scale", {3, 2}}};
  material["pbrMetallicRoughness"]["metallicRoughnessTexture"] = {{"index", 1}};
  material["pbrMetallicRoughness"]["metallicFactor"] = 0.7;
  material["pbrMetallicRoughness"]["roughnessFactor"] = 0.3;
  material["normalTexture"] = {{"index", 1}, {"scale", 0.75}};
  material["occlusionTexture"] = {{"index", 1}, {"strength", 0.5}};
  material["emissiveTexture"] = {{"index", 1}};
  material["emissiveFactor"] = {1, 0.5, 0.25};
  material["extensions"]["KHR_materials_emissive_strength"] = {{"emissiveStrength", 2}};
  for (const ExtensionTexture& row : kExtensionTextures) {
    material["extensions"][std::string(row.extension)][std::string(row.texture)] = {{"index", 1}};
  }
  material["extensions"]["KHR_materials_clearcoat"]["clearcoatNormalTexture"]["scale"] = 0.5;
  material["extensions"]["KHR_materials_sheen"]["sheenColorTexture"]["extensions"]["KHR_texture_transform"] = {
      {"offset", {0.5, 0}}};
  material["extensions"]["KHR_materials_anisotropy"]["anisotropyRotation"] = 0.25;
  material["alphaMode"] = "MASK";
  material["alphaCutoff"] = 0.3;
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

  bool is_refused_by_strict(const json& document) {
    fixtures::write_bytes(folder_ / "strict.gltf", document.dump());
    try {
      import_surface(folder_ / "strict.gltf", {.fill_holes = 0, .strict = true});
      return false;
    } catch (const Error& error) {
      return error.code() == ExitCode::kUnusableInput;
    }
  }

  bool has_note(const std::string& text) const {
    return std::any_of(notes_.begin(), notes_.end(),
                       [&](const std::string& note) { return note.find(text) != std::string::npos; });
  }

  TestFolder folder_;
  std::vector<std::string> notes_;
};

TEST_F(Materials, ComeInWholeAndTheMeshsFileGivesThemBack) {
  const SourceMesh mesh = import(whole_document());
  EXPECT_TRUE(notes_.empty());
  ASSERT_EQ(mesh.material_looks.size(), 1U);
  ASSERT_EQ(mesh.images.size(), 2U);
  const Material& look = mesh.material_looks[0];
  const TextureUse& tiles = look.texture(TextureRole::kBaseColour);
  EXPECT_EQ(mesh.images[tiles.image].name, "tiles");
  EXPECT_EQ(tiles.wrap_u, Wrap::kMirror);
  EXPECT_EQ(tiles.wrap_v, Wrap::kClamp);
  EXPECT_TRUE(tiles.is_blocky);
  EXPECT_EQ(tiles.scale, Vec2d(3, 2));
  EXPECT_EQ(tiles.offset, Vec2d(0.25, 0.125));
  EXPECT_EQ(tiles.rotation, 0.5);
  EXPECT_EQ(look.metallic, 0.7);
  EXPECT_EQ(look.roughness, 0.3);
  EXPECT_EQ(look.occlusion_strength, 0.5);
  EXPECT_EQ(look.normal_scale, 0.75);
  EXPECT_EQ(look.emissive, Vec3d(1, 0.5, 0.25));
  EXPECT_EQ(look.emissive_strength, 2);
  EXPECT_EQ(look.alpha_mode, AlphaMode::kMask);
  EXPECT_EQ(look.alpha_cutoff, 0.3);
  for (const TextureRole role : kTextureRoles) EXPECT_TRUE(look.texture(role).exists());
  EXPECT_EQ(look.clearcoat_normal_scale, 0.5);
  EXPECT_EQ(look.texture(TextureRole::kSheenColour).offset, Vec2d(0.5, 0));
  EXPECT_EQ(look.anisotropy_rotation, 0.25);

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

TEST_F(Materials, SayInANoteWhatIsNotTakenOfThem) {
  json document = whole_document();
  document["materials"][0]["extensions"]["ACME_materials_fur"] = {{"length", 1}};
  import(document);
  EXPECT_TRUE(has_note("without ACME_materials_fur"));
}

TEST_F(Materials, TakeTheirPicturesFromDataUrisAndFromTheAssetsFolder) {
  fixtures::write_bytes(folder_ / "paint.png", picture());
  for (const std::string& uri : {std::string("paint.png"), picture_uri()}) {
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
    // KTX2 is sound, but for others.
    EXPECT_EQ(is_refused_by_strict(textured_document({{"uri", uri}})), uri != "basis.ktx2") << uri;
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
  json document = textured_document({{"uri", picture_uri()}});
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
  json document = textured_document({{"uri", picture_uri()}});
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

TEST_F(Materials, KeepWhatExtensionsSayWithoutTextures) {
  json root = whole_document();
  root["materials"][0]["extensions"] = {
      {"KHR_materials_clearcoat", {{"clearcoatFactor", 3}, {"oddTexture", {{"index", 0}}}, {"odd", 1}}},
      {"KHR_materials_unlit", json::object()},
      {"KHR_materials_ior", {{"ior", "glass"}}},
      {"KHR_materials_volume", {{"attenuationColor", {1, 0.5, 0.25}}, {"attenuationDistance", 2}}},
      {"ACME_materials_fur", {{"length", 1}}}};
  const SourceMesh mesh = import(root);
  const json kept = json::parse(mesh.material_looks.at(0).extensions);
  EXPECT_EQ(kept,
            (json{{"KHR_materials_clearcoat", {{"clearcoatFactor", 1.0}}},
                  {"KHR_materials_unlit", json::object()},
                  {"KHR_materials_volume", {{"attenuationColor", {1.0, 0.5, 0.25}}, {"attenuationDistance", 2.0}}}}))
      << kept;
  EXPECT_TRUE(has_note("materials taken without ACME_materials_fur, KHR_materials_clearcoat's oddTexture"));
  write_source_mesh(folder_ / "mesh.glb", mesh);
  EXPECT_EQ(read_source_mesh(folder_ / "mesh.glb").material_looks, mesh.material_looks);
}

TEST_F(Materials, OfGlossAreToldByMetalAndRoughness) {
  const auto look = [&](const json& gloss) {
    json root = textured_document({{"uri", picture_uri()}});
    root["materials"][0] = {{"extensions", {{"KHR_materials_pbrSpecularGlossiness", gloss}}}};
    return import(root).material_looks.at(0);
  };
  const Material plastic = look(
      {{"diffuseFactor", {0.48, 0.24, 0.96, 0.5}}, {"specularFactor", {0.04, 0.04, 0.04}}, {"glossinessFactor", 0.75}});
  EXPECT_EQ(plastic.metallic, 0);
  EXPECT_EQ(plastic.roughness, 0.25);
  EXPECT_NEAR((plastic.base_colour - Vec4d(0.48, 0.24, 0.96, 0.5)).length(), 0, 1e-9);
  const Material gold = look({{"diffuseFactor", {0, 0, 0, 1}}, {"specularFactor", {1, 0.75, 0.25}}});
  EXPECT_NEAR(gold.metallic, 1, 1e-9);
  EXPECT_EQ(gold.roughness, 0);
  EXPECT_NEAR((gold.base_colour - Vec4d(1, 0.75, 0.25, 1)).length(), 0, 1e-9);
  const Material painted = look({{"diffuseTexture", {{"index", 0}}}, {"specularGlossinessTexture", {{"index", 0}}}});
  EXPECT_EQ(painted.texture(TextureRole::kBaseColour).image, 0);
  EXPECT_TRUE(has_note("specularGlossinessTexture"));
}

TEST_F(Materials, AreTheDefaultOnesOfVariants) {
  json root = whole_document();
  root["extensions"]["KHR_materials_variants"]["variants"] = {{{"name", "day"}}, {{"name", "night"}}};
  import(root);
  EXPECT_TRUE(has_note("2 variants of materials left out"));
}

TEST_F(Materials, TakeThePictureThatAllKnowWhereTheOtherOnesNumberIsNone) {
  json root = textured_document({{"uri", picture_uri()}});
  for (const double number : {1e308, -1e308, 77.0}) {
    root["textures"][0] = {{"source", 0}, {"extensions", {{"EXT_texture_webp", {{"source", number}}}}}};
    EXPECT_EQ(import(root).material_looks.at(0).texture(TextureRole::kBaseColour).image, 0) << number;
  }
}

TEST_F(Materials, GoWithoutKtxTexturesOrHaveTheirFallback) {
  json root = textured_document({{"uri", picture_uri()}});
  root["images"].push_back({{"uri", "data:image/ktx2;base64,q0tUWCAyMLsNChoKAAAAAA=="}});
  root["textures"][0] = {{"source", 0}, {"extensions", {{"KHR_texture_basisu", {{"source", 1}}}}}};
  EXPECT_EQ(import(root).material_looks.at(0).texture(TextureRole::kBaseColour).image, 0);
  EXPECT_TRUE(notes_.empty());
  root["textures"][0].erase("source");
  EXPECT_FALSE(import(root).material_looks.at(0).texture(TextureRole::kBaseColour).exists());
  EXPECT_TRUE(has_note("KTX2"));
}

}  // namespace
}  // namespace lozenge
