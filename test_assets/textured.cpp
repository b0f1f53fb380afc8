// The surface of `seams_document` with all that glTF's core material has: a tiled texture that KHR_texture_transform
// moves, a mirrored one, roughness and metal, emission by a second set of texture coordinates, a normal texture,
// colours at vertices, holes by alpha, glass.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "test_assets/documents.h"
#include "test_assets/pictures.h"

namespace lozenge::test_assets {
namespace {

using nlohmann::json;
using Bytes = std::vector<std::uint8_t>;

/// Pictures are smooth: what is compared on the screen is where colours come from, and not how a filter treats edges.
Bytes tiles() {
  return picture([](double x, double y) {
    const double share = 0.5 + 0.5 * std::sin(2 * kTurn * x) * std::sin(2 * kTurn * y);
    return Shares{0.2 + 0.7 * share, 0.5 + 0.2 * std::cos(kTurn * x), 0.6 - 0.4 * share};
  });
}

/// Not the same seen in a mirror.
Bytes slope() {
  return picture([](double x, double y) { return Shares{x, y, 0.25 + 0.5 * x * y}; });
}

Bytes occlusion_roughness_metal() {
  return picture([](double x, double y) {
    return Shares{0.5 + 0.5 * std::abs(std::cos(kTurn * x)), 0.5 + 0.25 * std::cos(kTurn * y),
                  0.5 + 0.5 * std::cos(kTurn * x)};
  });
}

Bytes lamps() {
  return picture([](double x, double y) {
    const double lit = std::clamp(1.5 - 5 * std::hypot(x - 0.5, y - 0.5), 0.0, 1.0);
    return Shares{lit, 0.5 * lit, 0.1 * lit};
  });
}

/// Round holes where alpha is low.
Bytes lattice() {
  return picture([](double x, double y) {
    const double wave = 0.5 + 0.5 * std::cos(4 * kTurn * x) * std::cos(2 * kTurn * y);
    return SharesWithAlpha{0.8, 0.3 + 0.3 * wave, 0.2, wave};
  });
}

/// Clearer on one side.
Bytes glass() {
  return picture([](double x, double y) {
    return SharesWithAlpha{0.3, 0.8 - 0.3 * y, 0.9, 0.5 + 0.3 * std::cos(kTurn * x)};
  });
}

}  // namespace

Encoded textured() {
  Document document = seams_document();
  document.materials.push_back({"lattice", {1, 1, 1, 1}, true});
  document.materials.push_back({"glass", {1, 1, 1, 0.75}});
  document.meshes.push_back({globe(24, 12, 3)});
  document.meshes.push_back({globe(24, 12, 4)});
  document.roots.push_back(static_cast<std::int32_t>(document.nodes.size()));
  document.nodes.push_back({.name = "Lattice", .mesh = 2, .translation = {0.5, 1.25, 2}});
  document.roots.push_back(static_cast<std::int32_t>(document.nodes.size()));
  document.nodes.push_back({.name = "Glass", .mesh = 3, .translation = {0.5, 1.25, -2.5}});
  for (auto& mesh : document.meshes) {
    for (Primitive& primitive : mesh) {
      for (const Vec2f& uv : primitive.uvs) {
        if (primitive.material == 1) primitive.more_uvs.emplace_back(0.25F + 0.5F * uv.y, uv.x);
      }
      if (primitive.material >= 2) primitive.normals = primitive.positions;
      if (primitive.material != 2) continue;
      for (const Vec3f& p : primitive.positions)
        primitive.colors.emplace_back(0.5F + 0.5F * std::abs(p.z), 1, 0.75F, 1);
    }
  }
  Encoded encoded = encode(document);
  json root = json::parse(encoded.json);
  add_image(encoded, root, "tiles", tiles());
  add_image(encoded, root, "slope", slope());
  add_image(encoded, root, "orm", occlusion_roughness_metal());
  add_image(encoded, root, "lamps", lamps());
  add_image(encoded, root, "hills", hills());
  add_image(encoded, root, "lattice", lattice());
  add_image(encoded, root, "glass", glass());
  constexpr int kRepeat = 10497;
  constexpr int kMirror = 33648;
  root["samplers"] = {{{"wrapS", kRepeat}, {"wrapT", kRepeat}}, {{"wrapS", kMirror}, {"wrapT", kMirror}}};
  root["textures"] = {{{"source", 0}, {"sampler", 0}}, {{"source", 1}, {"sampler", 1}}, {{"source", 2}, {"sampler", 0}},
                      {{"source", 3}, {"sampler", 0}}, {{"source", 4}, {"sampler", 0}}, {{"source", 5}, {"sampler", 0}},
                      {{"source", 6}, {"sampler", 0}}};
  // Viewers don't agree on what comes first, so both directions are scaled alike where there is a turn, too.
  const json moved = {{"KHR_texture_transform", {{"offset", {0.25, 0.125}}, {"rotation", 0.5}, {"scale", {2.5, 2.5}}}}};
  json& bronze = root["materials"][0];
  bronze["pbrMetallicRoughness"] = {{"baseColorTexture", {{"index", 0}, {"extensions", moved}}},
                                    {"metallicRoughnessTexture", {{"index", 2}}}};
  bronze["occlusionTexture"] = {{"index", 2}, {"strength", 0.5}};
  // As dense along the ring as around it: viewers that derive tangents from the screen lean normals by less where it
  // isn't.
  bronze["normalTexture"] = {
      {"index", 4}, {"scale", 0.75}, {"extensions", {{"KHR_texture_transform", {{"scale", {3.5, 1}}}}}}};
  json& glaze = root["materials"][1];
  glaze["emissiveTexture"] = {{"index", 3}, {"texCoord", 1}};
  glaze["emissiveFactor"] = {1, 1, 0.5};
  glaze["extensions"] = {{"KHR_materials_emissive_strength", {{"emissiveStrength", 2}}}};
  root["materials"][2]["pbrMetallicRoughness"]["baseColorTexture"] = {
      {"index", 1}, {"extensions", {{"KHR_texture_transform", {{"scale", {2, 2}}}}}}};
  root["materials"][3]["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 5}};
  root["materials"][3]["alphaMode"] = "MASK";
  root["materials"][3]["alphaCutoff"] = 0.3;
  root["materials"][4]["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 6}};
  root["materials"][4]["alphaMode"] = "BLEND";
  root["extensionsUsed"] = {"KHR_texture_transform", "KHR_materials_emissive_strength"};
  root["buffers"][0]["byteLength"] = encoded.binary.size();
  encoded.json = root.dump();
  return encoded;
}

}  // namespace lozenge::test_assets
