#include "test_assets/gltf_writer.h"

#include <algorithm>
#include <bit>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace lozenge::test_assets {
namespace {

using nlohmann::json;

static_assert(std::endian::native == std::endian::little, "glTF's buffers are little-endian");

constexpr int kFloat = 5126;
constexpr int kUnsignedByte = 5121;
constexpr int kUnsignedShort = 5123;
constexpr int kUnsignedInt = 5125;
constexpr int kArrayBuffer = 34962;
constexpr int kElementArrayBuffer = 34963;

template <typename T>
int append_accessor(json& root, std::vector<std::uint8_t>& binary, const std::vector<T>& values, int component,
                    const char* type, int target) {
  const std::size_t offset = binary.size();
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(values.data());
  binary.insert(binary.end(), bytes, bytes + values.size() * sizeof(T));
  root["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", offset}, {"byteLength", binary.size() - offset}});
  if (target != 0) root["bufferViews"].back()["target"] = target;
  binary.resize((binary.size() + 3) / 4 * 4);
  root["accessors"].push_back({{"bufferView", root["bufferViews"].size() - 1},
                               {"componentType", component},
                               {"count", values.size()},
                               {"type", type}});
  return static_cast<int>(root["accessors"].size()) - 1;
}

/// Sets the bounds of an accessor of positions or offsets.
void bound(json& accessor, const std::vector<Vec3f>& values) {
  Vec3f low = values.front();
  Vec3f high = values.front();
  for (const Vec3f& p : values) {
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], p[axis]);
      high[axis] = std::max(high[axis], p[axis]);
    }
  }
  accessor["min"] = {low.x, low.y, low.z};
  accessor["max"] = {high.x, high.y, high.z};
}

int append_positions(json& root, std::vector<std::uint8_t>& binary, const std::vector<Vec3f>& positions) {
  const int accessor = append_accessor(root, binary, positions, kFloat, "VEC3", kArrayBuffer);
  bound(root["accessors"][accessor], positions);
  return accessor;
}

/// Elements of 6 bytes, 8 apart, as vertex attributes must be.
int append_quantized(json& root, std::vector<std::uint8_t>& binary, const std::vector<Vec3f>& positions) {
  std::vector<std::array<std::uint16_t, 4>> whole;
  for (const Vec3f& p : positions) {
    whole.push_back(
        {static_cast<std::uint16_t>(p.x), static_cast<std::uint16_t>(p.y), static_cast<std::uint16_t>(p.z)});
  }
  const int accessor = append_accessor(root, binary, whole, kUnsignedShort, "VEC3", kArrayBuffer);
  root["bufferViews"].back()["byteStride"] = 8;
  bound(root["accessors"][accessor], positions);
  root["extensionsUsed"] = root["extensionsRequired"] = {"KHR_mesh_quantization"};
  return accessor;
}

/// An accessor without a view of its own.
int append_sparse(json& root, std::vector<std::uint8_t>& binary, const std::vector<Vec3f>& values) {
  std::vector<std::uint16_t> places;
  std::vector<Vec3f> there;
  for (std::size_t v = 0; v < values.size(); ++v) {
    if (values[v] == Vec3f(0, 0, 0)) continue;
    places.push_back(static_cast<std::uint16_t>(v));
    there.push_back(values[v]);
  }
  json accessor{{"componentType", kFloat}, {"count", values.size()}, {"type", "VEC3"}};
  bound(accessor, values);
  if (!places.empty()) {
    const int indices = append_accessor(root, binary, places, kUnsignedShort, "SCALAR", 0);
    const int changed = append_accessor(root, binary, there, kFloat, "VEC3", 0);
    const json of_indices = root["accessors"][indices];
    const json of_values = root["accessors"][changed];
    root["accessors"].erase(changed);
    root["accessors"].erase(indices);
    accessor["sparse"] = {{"count", places.size()},
                          {"indices", {{"bufferView", of_indices["bufferView"]}, {"componentType", kUnsignedShort}}},
                          {"values", {{"bufferView", of_values["bufferView"]}}}};
  }
  root["accessors"].push_back(accessor);
  return static_cast<int>(root["accessors"].size()) - 1;
}

int append_indices(json& root, std::vector<std::uint8_t>& binary, const Primitive& primitive) {
  if (primitive.positions.size() > 65535) {
    return append_accessor(root, binary, primitive.indices, kUnsignedInt, "SCALAR", kElementArrayBuffer);
  }
  const std::vector<std::uint16_t> narrow(primitive.indices.begin(), primitive.indices.end());
  return append_accessor(root, binary, narrow, kUnsignedShort, "SCALAR", kElementArrayBuffer);
}

json encoded(json& root, std::vector<std::uint8_t>& binary, const Primitive& primitive) {
  json object;
  object["attributes"]["POSITION"] = primitive.quantized ? append_quantized(root, binary, primitive.positions)
                                                         : append_positions(root, binary, primitive.positions);
  for (const Target& target : primitive.targets) {
    json of_target{{"POSITION", append_sparse(root, binary, target.offsets)}};
    if (!target.normals.empty()) of_target["NORMAL"] = append_sparse(root, binary, target.normals);
    object["targets"].push_back(of_target);
  }
  if (!primitive.normals.empty()) {
    object["attributes"]["NORMAL"] = append_accessor(root, binary, primitive.normals, kFloat, "VEC3", kArrayBuffer);
  }
  if (!primitive.uvs.empty()) {
    object["attributes"]["TEXCOORD_0"] = append_accessor(root, binary, primitive.uvs, kFloat, "VEC2", kArrayBuffer);
  }
  if (!primitive.more_uvs.empty()) {
    object["attributes"]["TEXCOORD_1"] =
        append_accessor(root, binary, primitive.more_uvs, kFloat, "VEC2", kArrayBuffer);
  }
  if (!primitive.colors.empty()) {
    object["attributes"]["COLOR_0"] = append_accessor(root, binary, primitive.colors, kFloat, "VEC4", kArrayBuffer);
  }
  if (!primitive.joints.empty()) {
    object["attributes"]["JOINTS_0"] =
        append_accessor(root, binary, primitive.joints, kUnsignedByte, "VEC4", kArrayBuffer);
    object["attributes"]["WEIGHTS_0"] = append_accessor(root, binary, primitive.weights, kFloat, "VEC4", kArrayBuffer);
  }
  object["indices"] = append_indices(root, binary, primitive);
  if (primitive.material >= 0) object["material"] = primitive.material;
  return object;
}

json encoded(const Node& node) {
  json object;
  object["name"] = node.name;
  if (node.mesh >= 0) object["mesh"] = node.mesh;
  if (!node.children.empty()) object["children"] = node.children;
  if (!node.translation.empty()) object["translation"] = node.translation;
  if (!node.rotation.empty()) object["rotation"] = node.rotation;
  if (!node.scale.empty()) object["scale"] = node.scale;
  if (!node.matrix.empty()) object["matrix"] = node.matrix;
  if (node.skin >= 0) object["skin"] = node.skin;
  return object;
}

json encoded(json& root, std::vector<std::uint8_t>& binary, const Skin& skin) {
  return {{"joints", skin.joints},
          {"inverseBindMatrices", append_accessor(root, binary, skin.inverse_binds, kFloat, "MAT4", 0)}};
}

json encoded(json& root, std::vector<std::uint8_t>& binary, const Animation& animation) {
  const int input = append_accessor(root, binary, animation.times, kFloat, "SCALAR", 0);
  root["accessors"][input]["min"] = {animation.times.front()};
  root["accessors"][input]["max"] = {animation.times.back()};
  const std::size_t components = animation.values.size() / animation.times.size();
  const bool are_weights = animation.path == "weights";
  const char* type = are_weights ? "SCALAR" : components == 4 ? "VEC4" : "VEC3";
  const int output = append_accessor(root, binary, animation.values, kFloat, type, 0);
  if (!are_weights) root["accessors"][output]["count"] = animation.times.size();
  return {{"name", animation.name},
          {"channels", {{{"sampler", 0}, {"target", {{"node", animation.node}, {"path", animation.path}}}}}},
          {"samplers", {{{"input", input}, {"output", output}}}}};
}

void append_word(std::vector<std::uint8_t>& bytes, std::uint32_t word) {
  for (int shift = 0; shift < 32; shift += 8) bytes.push_back(static_cast<std::uint8_t>(word >> shift));
}

}  // namespace

Encoded encode(const Document& document, const std::string& buffer_uri) {
  Encoded result;
  json root;
  root["asset"] = {{"version", "2.0"}, {"generator", "Lozenge test assets"}};
  root["scene"] = 0;
  root["scenes"] = json::array({{{"name", document.scene_name}, {"nodes", document.roots}}});
  for (const Node& node : document.nodes) root["nodes"].push_back(encoded(node));
  for (const auto& mesh : document.meshes) {
    json primitives = json::array();
    for (const Primitive& primitive : mesh) primitives.push_back(encoded(root, result.binary, primitive));
    root["meshes"].push_back({{"primitives", std::move(primitives)}});
    for (const Target& target : mesh.empty() ? std::vector<Target>() : mesh.front().targets) {
      root["meshes"].back()["weights"].push_back(target.weight);
      root["meshes"].back()["extras"]["targetNames"].push_back(target.name);
    }
  }
  for (const Skin& skin : document.skins) root["skins"].push_back(encoded(root, result.binary, skin));
  for (const Animation& animation : document.animations) {
    root["animations"].push_back(encoded(root, result.binary, animation));
  }
  for (const Material& material : document.materials) {
    root["materials"].push_back(
        {{"name", material.name},
         {"pbrMetallicRoughness", {{"baseColorFactor", material.base_color}, {"metallicFactor", 0}}}});
    if (material.double_sided) root["materials"].back()["doubleSided"] = true;
  }
  if (!result.binary.empty()) {
    root["buffers"] = json::array({{{"byteLength", result.binary.size()}}});
    if (!buffer_uri.empty()) root["buffers"][0]["uri"] = buffer_uri;
  }
  result.json = root.dump();
  return result;
}

std::vector<std::uint8_t> glb_bytes(const Encoded& encoded) {
  std::string text = encoded.json;
  text.resize((text.size() + 3) / 4 * 4, ' ');
  std::vector<std::uint8_t> binary = encoded.binary;
  binary.resize((binary.size() + 3) / 4 * 4);

  std::vector<std::uint8_t> bytes{'g', 'l', 'T', 'F'};
  append_word(bytes, 2);
  append_word(bytes, static_cast<std::uint32_t>(12 + 8 + text.size() + (binary.empty() ? 0 : 8 + binary.size())));
  append_word(bytes, static_cast<std::uint32_t>(text.size()));
  append_word(bytes, 0x4E4F534A);  // "JSON"
  bytes.insert(bytes.end(), text.begin(), text.end());
  if (!binary.empty()) {
    append_word(bytes, static_cast<std::uint32_t>(binary.size()));
    append_word(bytes, 0x004E4942);  // "BIN\0"
    bytes.insert(bytes.end(), binary.begin(), binary.end());
  }
  return bytes;
}

void write_bytes(const std::filesystem::path& file, const std::vector<std::uint8_t>& bytes) {
  std::ofstream stream(file, std::ios::binary);
  stream.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  if (!stream.flush()) throw std::runtime_error(file.string() + ": can't be written");
}

void write_text(const std::filesystem::path& file, const std::string& text) {
  write_bytes(file, {text.begin(), text.end()});
}

void write_glb(const std::filesystem::path& file, const Document& document) {
  write_bytes(file, glb_bytes(encode(document)));
}

void write_gltf(const std::filesystem::path& file, const Document& document) {
  const std::filesystem::path buffer = std::filesystem::path(file).replace_extension(".bin");
  const Encoded encoded = encode(document, buffer.filename().string());
  write_text(file, encoded.json);
  write_bytes(buffer, encoded.binary);
}

}  // namespace lozenge::test_assets
