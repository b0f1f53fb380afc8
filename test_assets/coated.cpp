// Three balls with textures of glTF's extensions of materials: lacquer, velvet, and brushed steel.
#include <nlohmann/json.hpp>

#include "test_assets/documents.h"
#include "test_assets/pictures.h"

namespace lozenge::test_assets {
namespace {

using nlohmann::json;

/// Coat in red, its roughness in green.
std::vector<std::uint8_t> coat() {
  return picture([](double x, double y) {
    return Shares{0.5 + 0.5 * std::cos(kTurn * x), 0.25 + 0.25 * std::sin(kTurn * y), 0};
  });
}

std::vector<std::uint8_t> shimmer() {
  return picture([](double x, double y) { return Shares{x, 0.5, y}; });
}

/// Says of specular reflection the same everywhere.
std::vector<std::uint8_t> even() {
  return picture([](double, double) { return SharesWithAlpha{1, 1, 1, 0.6}; });
}

json material(const std::string& name, const std::array<double, 4>& colour, double metallic, double roughness) {
  return {{"name", name},
          {"pbrMetallicRoughness",
           {{"baseColorFactor", colour}, {"metallicFactor", metallic}, {"roughnessFactor", roughness}}}};
}

}  // namespace

Encoded coated() {
  Document document;
  document.scene_name = "Coated";
  for (std::int32_t m = 0; m < 3; ++m) {
    document.materials.push_back({});
    document.meshes.push_back({globe(20, 10, m)});
    for (Primitive& primitive : document.meshes.back()) primitive.normals = primitive.positions;
    document.roots.push_back(m);
    document.nodes.push_back({.name = "Ball", .mesh = m, .translation = {2.5 * m, 0, 0}});
  }
  Encoded encoded = encode(document);
  json root = json::parse(encoded.json);
  add_image(encoded, root, "coat", coat());
  add_image(encoded, root, "hills", hills());
  add_image(encoded, root, "shimmer", shimmer());
  add_image(encoded, root, "even", even());
  root["textures"] = {{{"source", 0}}, {{"source", 1}}, {{"source", 2}}, {{"source", 3}}};
  json lacquer = material("lacquer", {0.5, 0.05, 0.05, 1}, 0, 0.6);
  lacquer["extensions"]["KHR_materials_clearcoat"] = {{"clearcoatFactor", 1},
                                                      {"clearcoatRoughnessFactor", 0.5},
                                                      {"clearcoatTexture", {{"index", 0}}},
                                                      {"clearcoatRoughnessTexture", {{"index", 0}}},
                                                      {"clearcoatNormalTexture", {{"index", 1}, {"scale", 0.5}}}};
  lacquer["normalTexture"] = {{"index", 1}, {"scale", 0.25}};
  json velvet = material("velvet", {0.05, 0.1, 0.2, 1}, 0, 0.9);
  velvet["extensions"]["KHR_materials_sheen"] = {
      {"sheenColorFactor", {1, 0.5, 1}},
      {"sheenRoughnessFactor", 0.5},
      {"sheenColorTexture", {{"index", 2}, {"extensions", {{"KHR_texture_transform", {{"scale", {2, 1}}}}}}}}};
  json steel = material("steel", {0.7, 0.7, 0.75, 1}, 1, 0.4);
  steel["extensions"]["KHR_materials_anisotropy"] = {{"anisotropyStrength", 0.8}, {"anisotropyRotation", 0.5}};
  for (json* each : {&lacquer, &velvet, &steel}) {
    (*each)["extensions"]["KHR_materials_specular"] = {{"specularFactor", 0.5}, {"specularTexture", {{"index", 3}}}};
  }
  root["materials"] = {lacquer, velvet, steel};
  root["extensionsUsed"] = {"KHR_materials_clearcoat", "KHR_materials_sheen", "KHR_materials_anisotropy",
                            "KHR_materials_specular", "KHR_texture_transform"};
  root["buffers"][0]["byteLength"] = encoded.binary.size();
  encoded.json = root.dump();
  return encoded;
}

}  // namespace lozenge::test_assets
