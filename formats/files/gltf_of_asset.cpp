#include "formats/files/gltf_of_asset.h"

#include <algorithm>
#include <cstring>
#include <nlohmann/json.hpp>

#include "formats/base/utf8.h"
#include "formats/base/version.h"
#include "formats/surface/attribute_streams.h"

namespace lozenge {

namespace {

using nlohmann::json;

constexpr int kFloat = 5126;
constexpr int kUnsignedInt = 5125;

class DocumentBuilder {
 public:
  explicit DocumentBuilder(const InputAsset& asset) {
    json_["asset"] = {{"version", "2.0"}, {"generator", "lozenge " + std::string(version())}};
    json_["scene"] = 0;
    json_["scenes"] = json::array({{{"nodes", {0}}}});
    const std::string name = valid_utf8(asset.scene_name);
    json_["nodes"] = json::array({{{"mesh", 0}, {"name", name}}});
    json_["meshes"] = json::array({{{"name", name}, {"primitives", json::array()}}});
    for (std::size_t m = 0; m < asset.material_names.size(); ++m) {
      json material{{"name", valid_utf8(asset.material_names[m])}};
      if (m < asset.double_sided.size() && asset.double_sided[m]) material["doubleSided"] = true;
      json_["materials"].push_back(std::move(material));
    }
  }

  void add(const Primitive& primitive) {
    json made{{"attributes", {{"POSITION", add_floats(primitive.positions, 3, true)}}}};
    for (const AttributeStream& stream : primitive.attributes) add_stream(stream, made["attributes"]);
    made["indices"] = add_indices(primitive.triangles);
    if (primitive.material >= 0) made["material"] = primitive.material;
    json_["meshes"][0]["primitives"].push_back(std::move(made));
  }

  GltfDocument take(const std::string& name) {
    json_["buffers"] = json::array({{{"byteLength", bytes_.size()}}});
    std::vector<std::vector<unsigned char>> buffers;
    buffers.push_back(std::move(bytes_));
    return make_gltf_document(std::move(json_), std::move(buffers), name);
  }

 private:
  void add_stream(const AttributeStream& stream, json& attributes) {
    AttributeStream fitted{stream.kind, stream.set, {}};
    append_fitted(fitted, stream.values, NormalTransform(Imath::M44d()));
    const bool loose = !stream.kind.loose_semantic.empty() && !all_unit(fitted, fitted.values);
    const std::string name = loose ? std::string(stream.kind.loose_semantic) : attribute_name(stream.kind, stream.set);
    attributes[name] = add_floats(fitted.values, stream.kind.components, false);
  }

  int add_view(const void* data, std::size_t size, int target) {
    const std::size_t offset = bytes_.size();
    bytes_.resize(offset + size);
    if (size > 0) std::memcpy(bytes_.data() + offset, data, size);
    json_["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", offset}, {"byteLength", size}, {"target", target}});
    return static_cast<int>(json_["bufferViews"].size()) - 1;
  }

  int add_floats(const std::vector<float>& values, int components, bool with_bounds) {
    static constexpr std::array<const char*, 4> kTypes{"SCALAR", "VEC2", "VEC3", "VEC4"};
    json accessor{{"bufferView", add_view(values.data(), values.size() * sizeof(float), 34962)},
                  {"componentType", kFloat},
                  {"count", values.size() / static_cast<std::size_t>(components)},
                  {"type", kTypes[static_cast<std::size_t>(components - 1)]}};
    for (int c = 0; with_bounds && c < components; ++c) {
      float low = values[static_cast<std::size_t>(c)];
      float high = low;
      for (auto i = static_cast<std::size_t>(c); i < values.size(); i += static_cast<std::size_t>(components)) {
        low = std::min(low, values[i]);
        high = std::max(high, values[i]);
      }
      accessor["min"].push_back(low);
      accessor["max"].push_back(high);
    }
    json_["accessors"].push_back(std::move(accessor));
    return static_cast<int>(json_["accessors"].size()) - 1;
  }

  int add_indices(const std::vector<std::array<std::uint32_t, 3>>& triangles) {
    json_["accessors"].push_back(
        {{"bufferView", add_view(triangles.data(), triangles.size() * sizeof(triangles[0]), 34963)},
         {"componentType", kUnsignedInt},
         {"count", 3 * triangles.size()},
         {"type", "SCALAR"}});
    return static_cast<int>(json_["accessors"].size()) - 1;
  }

  json json_;
  std::vector<unsigned char> bytes_;
};

}  // namespace

GltfDocument gltf_of_asset(InputAsset asset) {
  DocumentBuilder builder(asset);
  for (int p = 0; p < static_cast<int>(asset.meshes.front().primitives.size()); ++p) builder.add(asset.read(0, p));
  return builder.take(asset.file);
}

}  // namespace lozenge
