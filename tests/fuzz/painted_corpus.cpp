#include "tests/fuzz/painted_corpus.h"

#include <string>
#include <vector>

#include "formats/files/source_mesh_file.h"
#include "formats/files/texture_encoding.h"
#include "formats/patches/image_fixtures.h"
#include "formats/surface/extension_textures.h"
#include "stages/import/gltf_fixtures.h"
#include "stages/import/import_surface.h"

namespace lozenge::fuzz {

namespace {

namespace fs = std::filesystem;
using namespace testing_gltf;

/// A ramp in each channel, so that no two texels are the same.
BakedMap ramps(MapKind kind, std::int32_t channels) {
  BakedMap map = neutral_map(kind, fixtures::flat_normal_map().layout, 0, 1, channels);
  for (std::size_t i = 0; i < map.texels.size(); ++i) {
    map.texels[i] = static_cast<float>(i) / static_cast<float>(map.texels.size());
  }
  return map;
}

std::string encoded(const BakedMap& map, TextureFormat format) {
  const EncodedTexture texture = encoded_texture(map, {format});
  return {texture.bytes.begin(), texture.bytes.end()};
}

struct Pictures {
  std::string colours = encoded(ramps(MapKind::kBaseColour, 4), TextureFormat::kPng);
  std::string grey = encoded(ramps(MapKind::kOcclusion, 1), TextureFormat::kPng);
  std::string jpeg = encoded(ramps(MapKind::kBaseColour, 3), TextureFormat::kJpeg);
  std::string webp = encoded(ramps(MapKind::kBaseColour, 3), TextureFormat::kWebp);
};

int add_picture(TestGltf& gltf, const std::string& bytes, const char* mime_type) {
  const int view = gltf.add_view(std::vector<char>(bytes.begin(), bytes.end()));
  gltf.document["images"].push_back({{"bufferView", view}, {"mimeType", mime_type}});
  return static_cast<int>(gltf.document["images"].size()) - 1;
}

/// Pictures in the file, in the JSON, by an extension; samplers of all kinds.
void add_textures(TestGltf& gltf, const Pictures& pictures) {
  const int png = add_picture(gltf, pictures.colours, "image/png");
  const int jpeg = add_picture(gltf, pictures.jpeg, "image/jpeg");
  const int webp = add_picture(gltf, pictures.webp, "image/webp");
  const std::string uri = "data:image/png;base64," + base64(pictures.grey);
  gltf.document["images"].push_back({{"uri", uri}, {"name", "grey"}});
  gltf.document["samplers"] = {{{"wrapS", 33648}, {"wrapT", 33071}, {"magFilter", 9728}}, {{"minFilter", 9987}}};
  gltf.document["textures"] = {
      {{"source", png}, {"sampler", 0}},
      {{"source", jpeg}, {"sampler", 1}},
      {{"source", png}, {"extensions", {{"EXT_texture_webp", {{"source", webp}}}}}},
      {{"source", 3}},
  };
  gltf.document["extensionsUsed"] = {"EXT_texture_webp", "KHR_texture_transform", "KHR_materials_variants"};
}

/// All that a material may have, in a mask.
json whole_material() {
  const json moved = {{"offset", {0.25, 0.125}}, {"rotation", 0.5}, {"scale", {3, 2}}, {"texCoord", 1}};
  json material = {
      {"name", "whole"},
      {"pbrMetallicRoughness",
       {{"baseColorFactor", {0.5, 0.25, 1, 0.75}},
        {"baseColorTexture", {{"index", 0}, {"extensions", {{"KHR_texture_transform", moved}}}}},
        {"metallicRoughnessTexture", {{"index", 1}, {"texCoord", 1}}},
        {"metallicFactor", 0.5},
        {"roughnessFactor", 0.25}}},
      {"normalTexture", {{"index", 2}, {"scale", 0.5}}},
      {"occlusionTexture", {{"index", 3}, {"strength", 0.5}}},
      {"emissiveTexture", {{"index", 1}}},
      {"emissiveFactor", {1, 0.5, 0}},
      {"alphaMode", "MASK"},
      {"alphaCutoff", 0.25},
      {"doubleSided", true},
  };
  material["extensions"]["KHR_materials_emissive_strength"] = {{"emissiveStrength", 2}};
  for (const ExtensionTexture& row : kExtensionTextures) {
    json& extension = material["extensions"][std::string(row.extension)];
    extension[std::string(row.texture)] = {{"index", 0}};
    if (!row.factor.empty()) extension[std::string(row.factor)] = 1;
  }
  material["extensions"]["KHR_materials_sheen"]["sheenColorFactor"] = {1, 0.5, 0};
  material["extensions"]["KHR_materials_ior"] = {{"ior", 1.5}};
  return material;
}

/// Two primitives of materials of their own: one has all there is, the other is old, blended, and has another by day.
TestGltf painted(const Pictures& pictures) {
  TestGltf gltf = tetrahedron();
  add_textures(gltf, pictures);
  json& primitives = gltf.document["meshes"][0]["primitives"];
  const int first = gltf.add_values(std::vector<float>{0, 0, 1, 0, 0, 1, 1, 1}, "VEC2", kFloat);
  const int second = gltf.add_values(std::vector<std::uint8_t>{0, 9, 99, 255, 1, 2, 3, 4}, "VEC2", kUnsignedByte, true);
  const int colours = gltf.add_values(std::vector<float>(16, 0.5F), "VEC4", kFloat);
  const int normals = gltf.add_values(std::vector<float>{1, 0, 0, 1, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3", kFloat);
  const int tangents =
      gltf.add_values(std::vector<float>{0, 1, 0, 1, 0, 1, 0, -1, 0, 1, 0, 1, 0, 0, 1, 1}, "VEC4", kFloat);
  primitives[0]["attributes"].update(
      {{"TEXCOORD_0", first}, {"TEXCOORD_1", second}, {"NORMAL", normals}, {"TANGENT", tangents}});
  primitives.push_back(primitives[0]);
  primitives[1]["indices"] = gltf.add_values(std::vector<std::uint8_t>{0, 1, 3}, "SCALAR", kUnsignedByte);
  primitives[1]["attributes"]["COLOR_0"] = colours;
  primitives[0]["material"] = 0;
  primitives[1]["material"] = 1;
  primitives[1]["extensions"]["KHR_materials_variants"]["mappings"] = {{{"material", 0}, {"variants", {0}}}};
  gltf.document["extensions"]["KHR_materials_variants"]["variants"] = {{{"name", "day"}}};
  const json old = {{"diffuseFactor", {1, 0.5, 0, 0.5}},
                    {"diffuseTexture", {{"index", 2}}},
                    {"specularFactor", {0.5, 0.5, 0.5}},
                    {"glossinessFactor", 0.25}};
  gltf.document["materials"] = {
      whole_material(),
      {{"alphaMode", "BLEND"},
       {"extensions", {{"KHR_materials_pbrSpecularGlossiness", old}, {"KHR_materials_unlit", json::object()}}}}};
  return gltf;
}

}  // namespace

void write_painted_corpus(const fs::path& root) {
  const Pictures pictures;
  write_bytes(root / "texture" / "colours.png", pictures.colours);
  write_bytes(root / "texture" / "grey.png", pictures.grey);
  write_bytes(root / "texture" / "colours.jpg", pictures.jpeg);
  write_bytes(root / "texture" / "colours.webp", pictures.webp);
  const fs::path asset = root / "import" / "painted.glb";
  write_bytes(asset, painted(pictures).glb());
  // The same as the files of single stages carry it.
  const SourceMesh mesh = import_surface(asset, {});
  write_source_mesh(root / "import" / "painted_mesh.glb", mesh);
  write_source_mesh(root / "source_mesh" / "painted.glb", mesh);
}

}  // namespace lozenge::fuzz
