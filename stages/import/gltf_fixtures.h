// glTF files made by the tests of import, piece by piece, right or deliberately wrong.
#pragma once

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "formats/base/file_fixtures.h"
#include "formats/surface/attribute_fixtures.h"
#include "formats/surface/source_mesh.h"

namespace lozenge::testing_gltf {

using nlohmann::json;

inline constexpr int kByte = 5120, kUnsignedByte = 5121, kShort = 5122, kUnsignedShort = 5123, kUnsignedInt = 5125,
                     kFloat = 5126;

using fixtures::TestFolder;
using fixtures::write_bytes;

inline std::string word(std::uint32_t value) {
  std::string bytes(4, '\0');
  std::memcpy(bytes.data(), &value, 4);
  return bytes;
}

inline std::string base64(const std::string& bytes) {
  const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      group = (group << 8) | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    }
    for (int k = 0; k < 4; ++k) {
      text.push_back(i + static_cast<std::size_t>(k) > bytes.size() ? '=' : digits[(group >> (18 - 6 * k)) & 63]);
    }
  }
  return text;
}

/// A document with one buffer. The JSON is open for tests to add to and to break.
struct TestGltf {
  json document = {{"asset", {{"version", "2.0"}, {"generator", "a test"}}}};
  std::string bytes;

  template <typename T>
  int add_view(const std::vector<T>& values, int stride = 0) {
    bytes.resize((bytes.size() + 3) / 4 * 4, '\0');
    json view = {{"buffer", 0}, {"byteOffset", bytes.size()}, {"byteLength", values.size() * sizeof(T)}};
    if (stride > 0) view["byteStride"] = stride;
    bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
    document["bufferViews"].push_back(view);
    return static_cast<int>(document["bufferViews"].size()) - 1;
  }

  int add_accessor(const json& accessor) {
    document["accessors"].push_back(accessor);
    return static_cast<int>(document["accessors"].size()) - 1;
  }

  template <typename T>
  int add_values(const std::vector<T>& values, const std::string& type, int component_type, bool normalized = false) {
    const std::size_t components = type == "SCALAR" ? 1 : static_cast<std::size_t>(type.back() - '0');
    json accessor = {{"bufferView", add_view(values)},
                     {"componentType", component_type},
                     {"type", type},
                     {"count", values.size() / components}};
    if (normalized) accessor["normalized"] = true;
    return add_accessor(accessor);
  }

  int add_mesh(const json& primitives) {
    document["meshes"].push_back({{"primitives", primitives}});
    return static_cast<int>(document["meshes"].size()) - 1;
  }
  int add_node(const json& node) {
    document["nodes"].push_back(node);
    return static_cast<int>(document["nodes"].size()) - 1;
  }

  /// One node with a mesh of one primitive: these positions and indices.
  void add_simple_mesh(const std::vector<Vec3f>& positions, const std::vector<std::uint32_t>& indices) {
    const int p = add_values(flat(positions), "VEC3", kFloat);
    const int i = add_values(indices, "SCALAR", kUnsignedInt);
    add_node({{"mesh", add_mesh({{{"attributes", {{"POSITION", p}}}, {"indices", i}}})}});
  }

  static std::vector<float> flat(const std::vector<Vec3f>& positions) {
    std::vector<float> values;
    for (const Vec3f& p : positions) values.insert(values.end(), {p.x, p.y, p.z});
    return values;
  }

  std::string glb() {
    if (!document.contains("buffers")) document["buffers"] = {{{"byteLength", bytes.size()}}};
    return pack_glb(document.dump(), bytes);
  }
  /// The GLB of this text and these bytes, padded as it must be.
  static std::string pack_glb(std::string text, std::string binary) {
    text.resize((text.size() + 3) / 4 * 4, ' ');
    binary.resize((binary.size() + 3) / 4 * 4, '\0');
    std::string chunks = word(static_cast<std::uint32_t>(text.size())) + "JSON" + text;
    if (!binary.empty()) {
      chunks += word(static_cast<std::uint32_t>(binary.size())) + std::string("BIN\0", 4) + binary;
    }
    return "glTF" + word(2) + word(static_cast<std::uint32_t>(12 + chunks.size())) + chunks;
  }
  /// The JSON of a .gltf whose buffer is at `uri`.
  std::string gltf(const std::string& uri) {
    document["buffers"] = {{{"byteLength", bytes.size()}, {"uri", uri}}};
    return document.dump();
  }
  std::string data_uri() const { return "data:application/octet-stream;base64," + base64(bytes); }
};

/// A tetrahedron, facing outward.
inline std::vector<Vec3f> tetrahedron_positions() { return {{1, 1, 1}, {-1, -1, 1}, {-1, 1, -1}, {1, -1, -1}}; }
inline std::vector<std::uint32_t> tetrahedron_indices() { return {0, 1, 3, 0, 2, 1, 0, 3, 2, 1, 2, 3}; }

inline TestGltf tetrahedron() {
  TestGltf gltf;
  gltf.add_simple_mesh(tetrahedron_positions(), tetrahedron_indices());
  return gltf;
}

/// Six times the volume that the triangles enclose: positive where they face outward.
inline double enclosed_volume(const SourceMesh& mesh) {
  double volume = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    volume += Vec3d(mesh.positions[a]).dot(Vec3d(mesh.positions[b]).cross(Vec3d(mesh.positions[c])));
  }
  return volume;
}

template <typename T>
bool same_bits(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

inline void expect_same_mesh(const SourceMesh& a, const SourceMesh& b) {
  EXPECT_TRUE(same_bits(a.positions, b.positions));
  EXPECT_TRUE(same_bits(a.triangles, b.triangles));
  EXPECT_TRUE(fixtures::same_bits(a.corner_attributes, b.corner_attributes));
  EXPECT_EQ(a.materials, b.materials);
  EXPECT_EQ(a.material_names, b.material_names);
}

}  // namespace lozenge::testing_gltf
