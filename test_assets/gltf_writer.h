// A small writer of glTF files for the test assets. It stands on its own, so that the product's reader and its test
// data can't share a mistake, and it writes broken files as willingly as sound ones.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "formats/base/vector.h"

namespace lozenge::test_assets {

/// Written as sparse accessors: only what isn't zero. What its mesh says of it is that of the first primitive.
struct Target {
  std::string name{};
  double weight = 0;
  std::vector<Vec3f> offsets{};  ///< one for each position
  std::vector<Vec3f> normals{};  ///< differences; empty, or one for each position
};

struct Primitive {
  std::vector<Vec3f> positions;
  std::vector<Vec3f> normals;  ///< empty, or one for each position
  std::vector<Vec2f> uvs;      ///< empty, or one for each position
  std::vector<Vec4f> colors;   ///< empty, or one for each position
  std::vector<std::uint32_t> indices;
  std::int32_t material = -1;
  std::vector<std::array<std::uint8_t, 4>> joints{};  ///< empty, or one for each position
  std::vector<std::array<float, 4>> weights{};        ///< the same
  std::vector<Vec2f> more_uvs{};                      ///< a second set: empty, or one for each position
  std::vector<Target> targets{};
  bool quantized = false;  ///< positions, whole numbers, are written as 16 bits (KHR_mesh_quantization)
};

struct Node {
  std::string name{};
  std::int32_t mesh = -1;
  std::vector<std::int32_t> children{};
  std::vector<double> translation{};  ///< empty or 3 numbers
  std::vector<double> rotation{};     ///< empty or 4: quaternion x, y, z, w
  std::vector<double> scale{};        ///< empty or 3
  std::vector<double> matrix{};       ///< empty or 16, column by column
  std::int32_t skin = -1;
};

struct Skin {
  std::vector<std::int32_t> joints;                  ///< nodes
  std::vector<std::array<float, 16>> inverse_binds;  ///< [joint], column by column
};

/// Keys of one property of one node.
struct Animation {
  std::string name{};
  std::int32_t node = 0;
  std::string path{};           ///< "translation", "rotation", "scale" or "weights"
  std::vector<float> times{};   ///< seconds
  std::vector<float> values{};  ///< three or four for each time, or as many as there are targets
};

struct Material {
  std::string name{};
  std::vector<double> base_color;  ///< linear RGBA
  bool double_sided = false;
};

struct Document {
  std::string scene_name;
  std::vector<std::vector<Primitive>> meshes;
  std::vector<Node> nodes;
  std::vector<std::int32_t> roots;  ///< nodes of the scene
  std::vector<Material> materials;
  std::vector<Skin> skins;
  std::vector<Animation> animations;
};

/// The JSON text, and the one buffer that it speaks of.
struct Encoded {
  std::string json;
  std::vector<std::uint8_t> binary;
};

/// `buffer_uri` is empty for a GLB.
Encoded encode(const Document& document, const std::string& buffer_uri = {});

/// Header, JSON chunk and binary chunk, padded.
std::vector<std::uint8_t> glb_bytes(const Encoded& encoded);

void write_bytes(const std::filesystem::path& file, const std::vector<std::uint8_t>& bytes);
void write_text(const std::filesystem::path& file, const std::string& text);
void write_glb(const std::filesystem::path& file, const Document& document);
/// Writes the buffer beside it, with the extension .bin.
void write_gltf(const std::filesystem::path& file, const Document& document);

}  // namespace lozenge::test_assets
