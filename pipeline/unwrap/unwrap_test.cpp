#include "pipeline/unwrap/unwrap.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "formats/base/error.h"
#include "formats/base/file_fixtures.h"
#include "formats/files/uv_surface_file.h"

namespace lozenge {
namespace {

using nlohmann::json;

/// A glTF document under construction, with all that hangs on its vertices: a wavy grid in two primitives, skinned,
/// morphed, coloured, placed twice; an animation, a material with textures, extras.
class Asset {
 public:
  explicit Asset(int n) {
    std::vector<float> positions, normals, uvs, colors, weights, custom, morph;
    std::vector<std::uint8_t> joints;
    for (int j = 0; j <= n; ++j) {
      for (int i = 0; i <= n; ++i) {
        const float x = static_cast<float>(i) / static_cast<float>(n);
        const float y = static_cast<float>(j) / static_cast<float>(n);
        positions.insert(positions.end(), {x, y, 0.2F * std::sin(6 * x) * std::cos(5 * y)});
        normals.insert(normals.end(), {0, 0, 1});
        uvs.insert(uvs.end(), {x, 1 - y});
        colors.insert(colors.end(), {x, y, 0.5F, 1});
        joints.insert(joints.end(), {0, 1, 0, 0});
        weights.insert(weights.end(), {1 - x, x, 0, 0});
        custom.push_back(3 * x + y);
        morph.insert(morph.end(), {0, 0, x});
      }
    }
    const json attributes{{"POSITION", add(positions, 3, true)},
                          {"NORMAL", add(normals, 3)},
                          {"TEXCOORD_0", add(uvs, 2)},
                          {"COLOR_0", add(colors, 4)},
                          {"JOINTS_0", add_joints(joints)},
                          {"WEIGHTS_0", add(weights, 4)},
                          {"_HEAT", add(custom, 1)}};
    const json target{{"POSITION", add(morph, 3, true)}};
    // Both halves use the same vertices.
    for (const int half : {0, 1}) {
      std::vector<std::uint32_t> indices;
      for (int j = half * n / 2; j < (half + 1) * n / 2; ++j) {
        for (int i = 0; i < n; ++i) {
          const auto v = static_cast<std::uint32_t>(j * (n + 1) + i);
          const auto up = v + static_cast<std::uint32_t>(n) + 1;
          indices.insert(indices.end(), {v, v + 1, up + 1, v, up + 1, up});
        }
      }
      primitives_.push_back({{"attributes", attributes},
                             {"targets", json::array({target})},
                             {"indices", add_indices(indices)},
                             {"material", 0},
                             {"extras", {{"half", half}}}});
    }
    document_["meshes"] = json::array({{{"name", "grid"}, {"primitives", primitives_}, {"weights", {0.0}}}});
    document_["asset"] = {{"version", "2.0"}, {"generator", "a test"}, {"extras", {{"kept", true}}}};
    document_["scene"] = 0;
    document_["scenes"] = json::array({{{"nodes", {0, 1, 2}}}});
    document_["nodes"] =
        json::array({{{"name", "first"}, {"mesh", 0}, {"skin", 0}},
                     {{"name", "second"}, {"mesh", 0}, {"scale", {2, 2, 2}}, {"translation", {3, 0, 0}}},
                     {{"name", "bone"}, {"extras", {{"x", 1}}}}});
    document_["skins"] = json::array({{{"joints", {2, 2}}}});
    document_["materials"] = json::array({{{"name", "red"}, {"pbrMetallicRoughness", {{"metallicFactor", 0.25}}}}});
    document_["animations"] = json::array(
        {{{"channels", json::array({{{"sampler", 0}, {"target", {{"node", 2}, {"path", "translation"}}}}})},
          {"samplers", json::array({{{"input", add({0, 1}, 1, true)}, {"output", add({0, 0, 0, 1, 2, 3}, 3)}}})}}});
  }

  json& document() { return document_; }

  void write(const std::filesystem::path& path) {
    document_["buffers"] = json::array({{{"byteLength", bytes_.size()}}});
    std::string text = document_.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    std::ofstream file(path, std::ios::binary);
    for (const std::size_t word : {std::size_t{0x46546C67}, std::size_t{2}, 28 + text.size() + bytes_.size(),
                                   text.size(), std::size_t{0x4E4F534A}}) {
      put(file, word);
    }
    file << text;
    put(file, bytes_.size());
    put(file, 0x004E4942);
    file.write(reinterpret_cast<const char*>(bytes_.data()), static_cast<std::streamsize>(bytes_.size()));
  }

 private:
  static void put(std::ostream& stream, std::size_t word) {
    for (int shift = 0; shift < 32; shift += 8) stream.put(static_cast<char>(word >> shift & 0xFF));
  }

  int accessor(const void* data, std::size_t size, json described) {
    const std::size_t offset = bytes_.size();
    bytes_.resize(offset + (size + 3) / 4 * 4);
    std::memcpy(bytes_.data() + offset, data, size);
    document_["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", offset}, {"byteLength", size}});
    described["bufferView"] = document_["bufferViews"].size() - 1;
    document_["accessors"].push_back(std::move(described));
    return static_cast<int>(document_["accessors"].size()) - 1;
  }

  int add(const std::vector<float>& values, int components, bool bounds = false) {
    const std::vector<std::string> types{"SCALAR", "VEC2", "VEC3", "VEC4"};
    json described{{"componentType", 5126},
                   {"count", values.size() / static_cast<std::size_t>(components)},
                   {"type", types[static_cast<std::size_t>(components) - 1]}};
    for (int c = 0; bounds && c < components; ++c) {
      float low = values[static_cast<std::size_t>(c)], high = low;
      for (auto i = static_cast<std::size_t>(c); i < values.size(); i += static_cast<std::size_t>(components)) {
        low = std::min(low, values[i]);
        high = std::max(high, values[i]);
      }
      described["min"].push_back(low);
      described["max"].push_back(high);
    }
    return accessor(values.data(), values.size() * sizeof(float), std::move(described));
  }
  int add_joints(const std::vector<std::uint8_t>& joints) {
    return accessor(joints.data(), joints.size(),
                    {{"componentType", 5121}, {"count", joints.size() / 4}, {"type", "VEC4"}});
  }
  int add_indices(const std::vector<std::uint32_t>& indices) {
    return accessor(indices.data(), 4 * indices.size(),
                    {{"componentType", 5125}, {"count", indices.size()}, {"type", "SCALAR"}});
  }

  json document_ = json::object();
  json primitives_ = json::array();
  std::vector<unsigned char> bytes_;
};

/// What was written, read without any of our own readers.
struct Written {
  explicit Written(const std::filesystem::path& path) {
    const std::string text = fixtures::bytes_of(path);
    std::uint32_t length = 0;
    std::memcpy(&length, &text[12], 4);
    document = json::parse(text.substr(20, length));
    binary = text.substr(28 + length);
  }

  std::vector<float> floats(const json& number) const {
    const json& described = document["accessors"][number.get<std::size_t>()];
    const json& view = document["bufferViews"][described["bufferView"].get<std::size_t>()];
    const std::map<std::string, std::size_t> widths{{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}};
    const std::size_t width = widths.at(described["type"]);
    std::vector<float> values(described["count"].get<std::size_t>() * width);
    const std::size_t offset = view.value("byteOffset", std::size_t{0});
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (described["componentType"] == 5121) {
        const std::size_t stride = view.value("byteStride", width);
        values[i] = static_cast<unsigned char>(binary[offset + i / width * stride + i % width]);
      } else {
        std::memcpy(&values[i], &binary[offset + 4 * i], 4);
      }
    }
    return values;
  }

  json document;
  std::string binary;
};

class Unwrap : public testing::Test {
 protected:
  UnwrapResult unwrapped(Asset asset, UnwrapOptions options = {}) {
    asset.write(folder_ / "in.glb");
    options.parameterize.min_domain_faces = 8;
    options.parameterize.max_domain_faces = 16;
    return unwrap(folder_ / "in.glb", folder_ / "out.glb", options);
  }
  Written written() const { return Written(folder_ / "out.glb"); }

  fixtures::TestFolder folder_;
};

/// The document without what unwrapping is about.
json all_else(json document) {
  for (const char* key : {"accessors", "bufferViews", "buffers"}) document.erase(key);
  for (json& mesh : document["meshes"]) {
    for (json& primitive : mesh["primitives"]) {
      for (const char* key : {"attributes", "indices", "targets", "mode"}) primitive.erase(key);
    }
  }
  for (json& animation : document["animations"]) {
    for (json& sampler : animation["samplers"]) sampler = nullptr;
  }
  return document;
}

TEST_F(Unwrap, LeavesTheAssetWhatItIsOtherwise) {
  Asset asset(12);
  const json before = asset.document();
  unwrapped(asset);
  const Written after = written();
  EXPECT_EQ(all_else(after.document), all_else(before));
  // The animation's accessors still hold what they did.
  const json& sampler = after.document["animations"][0]["samplers"][0];
  EXPECT_EQ(after.floats(sampler["input"]), (std::vector<float>{0, 1}));
  EXPECT_EQ(after.floats(sampler["output"]), (std::vector<float>{0, 0, 0, 1, 2, 3}));
}

TEST_F(Unwrap, InterpolatesWhateverVerticesCarry) {
  unwrapped(Asset(12));
  const Written after = written();
  for (const json& primitive : after.document["meshes"][0]["primitives"]) {
    const json& attributes = primitive["attributes"];
    const auto positions = after.floats(attributes["POSITION"]);
    const auto colors = after.floats(attributes["COLOR_0"]);
    const auto heat = after.floats(attributes["_HEAT"]);
    const auto weights = after.floats(attributes["WEIGHTS_0"]);
    const auto joints = after.floats(attributes["JOINTS_0"]);
    const auto morph = after.floats(primitive["targets"][0]["POSITION"]);
    ASSERT_GT(positions.size(), 0U);
    for (std::size_t v = 0; v < positions.size() / 3; ++v) {
      // All of it is linear in x and y.
      const float x = positions[3 * v];
      const float y = positions[3 * v + 1];
      EXPECT_NEAR(colors[4 * v], x, 1e-5);
      EXPECT_NEAR(colors[4 * v + 1], y, 1e-5);
      EXPECT_NEAR(heat[v], 3 * x + y, 1e-5);
      EXPECT_NEAR(morph[3 * v + 2], x, 1e-5);
      float sum = 0;
      float of_second = 0;
      for (std::size_t k = 0; k < 4; ++k) {
        sum += weights[4 * v + k];
        if (joints[4 * v + k] == 1) of_second += weights[4 * v + k];
      }
      EXPECT_NEAR(sum, 1, 1e-6);
      EXPECT_NEAR(of_second, x, 1e-5);
    }
  }
}

TEST_F(Unwrap, WritesTheSetThatIsAskedForAndKeepsTheOthers) {
  for (const int set : {0, 1, 3}) {
    UnwrapOptions options;
    options.uv_set = set;
    unwrapped(Asset(12), options);
    const Written after = written();
    for (const json& primitive : after.document["meshes"][0]["primitives"]) {
      const json& attributes = primitive["attributes"];
      for (int s = 0; s <= set; ++s) EXPECT_TRUE(attributes.contains("TEXCOORD_" + std::to_string(s)));
      if (set == 0) continue;
      const auto positions = after.floats(attributes["POSITION"]);
      const auto first = after.floats(attributes["TEXCOORD_0"]);
      for (std::size_t v = 0; v < first.size() / 2; ++v) {
        EXPECT_NEAR(first[2 * v], positions[3 * v], 1e-5);
        EXPECT_NEAR(first[2 * v + 1], 1 - positions[3 * v + 1], 1e-5);
      }
    }
    const UvStatistics uvs = uv_statistics(read_uv_surface(folder_ / "out.glb", set > 0 ? 0 : set), 2048);
    EXPECT_EQ(uvs.overlapping_texels, 0);
  }
}

TEST_F(Unwrap, LaysAllOfASurfaceIntoTheAtlasOnce) {
  for (const int gutter : {0, 2, 8}) {
    UnwrapOptions options;
    options.map_size = 512;
    options.gutter = gutter;
    const UnwrapResult result = unwrapped(Asset(12), options);
    EXPECT_EQ(result.meshes, 1);
    EXPECT_EQ(result.left_out, 0);
    const UvSurface surface = read_uv_surface(folder_ / "out.glb");
    EXPECT_EQ(static_cast<std::int64_t>(surface.triangles.size()), result.triangles);
    const UvStatistics uvs = uv_statistics(surface, 512);
    EXPECT_EQ(uvs.folded, 0);
    EXPECT_EQ(uvs.outside, 0);
    EXPECT_EQ(uvs.overlapping_texels, 0);
    EXPECT_GE(uvs.least_gap, std::min(2 * gutter, 16));
    EXPECT_NEAR(uvs.l2_stretch, result.atlases.front().l2_stretch, 0.05);
  }
}

TEST_F(Unwrap, GivesTheLargestPlacementTheTexelsThatAreAskedFor) {
  UnwrapOptions options;
  options.texels_per_unit = 100;
  const UnwrapResult result = unwrapped(Asset(12), options);
  EXPECT_GE(result.atlases.front().texels_per_unit, 100);
  EXPECT_LE(result.atlases.front().texels_per_unit, 110);
  // The second placement is twice as large: a length of 1 in the mesh is 2 there.
  const UvSurface surface = read_uv_surface(folder_ / "out.glb");
  double in_atlas = 0;
  for (const auto& [a, b, c] : surface.triangles) {
    in_atlas +=
        (Vec2d(surface.uvs[b]) - Vec2d(surface.uvs[a])).cross(Vec2d(surface.uvs[c]) - Vec2d(surface.uvs[a])) / 2;
  }
  const double texels = in_atlas * std::pow(result.atlases.front().map_size, 2);
  const double area = uv_statistics(surface, 64).area * 4;
  EXPECT_NEAR(std::sqrt(texels / area), result.atlases.front().texels_per_unit, 2);
}

TEST_F(Unwrap, MakesAnAtlasForEachMeshOnRequest) {
  Asset two(8);
  json& document = two.document();
  document["meshes"].push_back(document["meshes"][0]);
  document["nodes"][1]["mesh"] = 1;
  UnwrapOptions options;
  EXPECT_EQ(unwrapped(two, options).atlases.size(), 1U);
  options.pack_each = true;
  const UnwrapResult each = unwrapped(two, options);
  EXPECT_EQ(each.atlases.size(), 2U);
  EXPECT_EQ(each.meshes, 2);
}

TEST_F(Unwrap, CutsADuplicateAsTheTriangleThatItLiesOn) {
  Asset asset(4);
  // The second half is the first one again: repair leaves it out.
  json& primitives = asset.document()["meshes"][0]["primitives"];
  primitives[1]["indices"] = primitives[0]["indices"];
  const UnwrapResult result = unwrapped(asset);
  EXPECT_EQ(result.left_out, 2 * 4 * 2);
  const Written after = written();
  const json& made = after.document["meshes"][0]["primitives"];
  EXPECT_EQ(after.floats(made[0]["attributes"]["TEXCOORD_0"]), after.floats(made[1]["attributes"]["TEXCOORD_0"]));
}

TEST_F(Unwrap, RefusesAnAtlasThatIsTooSmallAndWritesNothing) {
  UnwrapOptions options;
  options.map_size = 16;
  options.gutter = 6;
  EXPECT_THROW(unwrapped(Asset(12), options), Error);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out.glb"));
}

TEST_F(Unwrap, TakesFormatsWithoutScenes) {
  std::ofstream(folder_ / "pyramid.obj") << "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv .5 .5 1\n"
                                            "f 1 4 3 2\nf 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\n";
  const UnwrapResult result = unwrap(folder_ / "pyramid.obj", folder_ / "out.glb", {});
  EXPECT_EQ(result.triangles_before, 6);
  EXPECT_EQ(uv_statistics(read_uv_surface(folder_ / "out.glb"), 2048).overlapping_texels, 0);
}

}  // namespace
}  // namespace lozenge
