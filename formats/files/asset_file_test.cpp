#include "formats/files/asset_file.h"
#include "formats/files/asset_fixtures.h"
#include "formats/files/asset_places.h"

#include <gtest/gtest.h>
#include <tiny_gltf.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>

#include "formats/base/error.h"
#include "formats/base/file_fixtures.h"
#include "formats/domain/sphere_fixtures.h"
#include "formats/files/baked_maps_file.h"
#include "formats/files/file_kind.h"
#include "formats/files/geometry_image_file.h"
#include "formats/files/gltf_writer.h"
#include "formats/files/parameterization_file.h"
#include "formats/files/patch_set_file.h"
#include "formats/files/source_mesh_file.h"
#include "formats/patches/image_fixtures.h"
#include "formats/patches/tangent_frame.h"

namespace lozenge {
namespace {

AssetTexture ramp() {
  AssetTexture texture;
  texture.width = 4;
  texture.height = 2;
  texture.channels = 1;
  texture.pixels = {0, 1, 2, 3, 10, 11, 12, 13};
  return texture;
}

TEST(SampleTexture, GivesATexelAtItsCentreAndTheMeanBetweenTwo) {
  const AssetTexture texture = ramp();
  for (int y = 0; y < 2; ++y) {
    for (int x = 0; x < 4; ++x) {
      EXPECT_FLOAT_EQ(sample_texture(texture, {(x + 0.5) / 4, (y + 0.5) / 2})[0], texture.pixels[y * 4 + x]);
    }
  }
  EXPECT_FLOAT_EQ(sample_texture(texture, {2.0 / 4, 0.25})[0], 1.5F);
  EXPECT_FLOAT_EQ(sample_texture(texture, {1.5 / 4, 0.5})[0], 6);
}

TEST(SampleTexture, RepeatsBeyondItsBorders) {
  const AssetTexture texture = ramp();
  for (const double u : {0.1, 0.4, 0.95}) {
    for (const double v : {0.05, 0.6}) {
      EXPECT_FLOAT_EQ(sample_texture(texture, {u, v})[0], sample_texture(texture, {u - 3, v + 2})[0]);
    }
  }
  EXPECT_FLOAT_EQ(sample_texture(texture, {0, 0.25})[0], 1.5F);  // between the last and the first
}

TEST(MappedNormal, IsWhatTheTangentFrameOfTheBakerMeans) {
  Asset asset = fixtures::sphere_asset();
  for (Vec4f& t : asset.levels[0].tangents) t.w = kBitangentSign;
  const Vec3d texel = Vec3d(0.3, -0.5, 0.8);
  for (std::size_t i = 0; i < asset.textures[0].pixels.size(); ++i) {
    asset.textures[0].pixels[i] = static_cast<float>(texel[static_cast<int>(i % 3)] * 0.5 + 0.5);
  }
  const AssetLevel& level = asset.levels[0];
  for (TriangleId t = 0; t < static_cast<TriangleId>(level.triangles.size()); t += 17) {
    std::array<FrameVertex, 3> corners;
    for (int c = 0; c < 3; ++c) {
      const VertexId v = level.triangles[t][c];
      const Vec4f& tangent = level.tangents[v];
      corners[c] = {level.normals[v], {tangent.x, tangent.y, tangent.z}, level.uvs[v]};
    }
    const Vec3d weights(0.5, 0.2, 0.3);
    const Vec3d expected = shading_frame({&corners[0], &corners[1], &corners[2]}, weights).to_object(texel);
    EXPECT_LT((Vec3d(mapped_normal(asset, level, t, weights)) - expected).length(), 1e-5);
  }
}

class AssetFiles : public testing::Test {
 protected:
  fixtures::TestFolder folder_;

  /// A triangle with everything that an asset has, and one coarser level.
  static tinygltf::Model small_asset() {
    tinygltf::Model model;
    GltfBuffer buffer(model);
    const std::vector<float> positions{0, 0, 0, 1, 0, 0, 0, 1, 0};
    const std::vector<float> normals{0, 0, 1, 0, 0, 1, 0, 0, 1};
    const std::vector<float> tangents{1, 0, 0, -1, 1, 0, 0, -1, 1, 0, 0, -1};
    const std::vector<float> uvs{0, 0, 1, 0, 0, 1};
    const std::vector<std::uint32_t> indices{0, 1, 2};
    tinygltf::Primitive primitive;
    primitive.attributes["POSITION"] = buffer.add_floats(positions, 3, true);
    primitive.attributes["NORMAL"] = buffer.add_floats(normals, 3);
    primitive.attributes["TANGENT"] = buffer.add_floats(tangents, 4);
    primitive.attributes["TEXCOORD_0"] = buffer.add_floats(uvs, 2);
    primitive.indices = buffer.add_indices(indices);
    primitive.material = 0;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    for (int level = 0; level < 2; ++level) {
      tinygltf::Mesh mesh;
      mesh.name = "level " + std::to_string(level);
      mesh.primitives.push_back(primitive);
      model.meshes.push_back(mesh);
      tinygltf::Node node;
      node.mesh = level;
      model.nodes.push_back(node);
    }
    model.nodes[0].extensions["MSFT_lod"] =
        tinygltf::Value(tinygltf::Value::Object{{"ids", tinygltf::Value(tinygltf::Value::Array{tinygltf::Value(1)})}});
    model.extensionsUsed.push_back("MSFT_lod");
    tinygltf::Image image;
    image.mimeType = "image/png";
    image.bufferView = buffer.add_bytes(png_of(fixtures::flat_normal_map(), 8));
    model.images.push_back(image);
    tinygltf::Texture texture;
    texture.source = 0;
    model.textures.push_back(texture);
    tinygltf::Material material;
    material.normalTexture.index = 0;
    model.materials.push_back(material);
    tinygltf::Scene scene;
    scene.name = "small";
    scene.nodes = {0};
    model.scenes.push_back(scene);
    model.defaultScene = 0;
    return model;
  }

  /// What reading the changed asset throws.
  ExitCode code_after(const std::function<void(tinygltf::Model&)>& change) {
    tinygltf::Model model = small_asset();
    change(model);
    write_glb(folder_ / "a.glb", model);
    try {
      read_asset(folder_ / "a.glb");
    } catch (const Error& e) {
      EXPECT_NE(std::string(e.what()).find("a.glb"), std::string::npos) << e.what();
      return e.code();
    }
    return ExitCode::kDone;
  }
};

TEST_F(AssetFiles, AreReadWithTheirLevelsAndTextures) {
  tinygltf::Model model = small_asset();
  write_glb(folder_ / "a.glb", model);
  const Asset asset = read_asset(folder_ / "a.glb");
  ASSERT_EQ(asset.levels.size(), 2U);
  EXPECT_EQ(asset.levels[1].name, "level 1");
  EXPECT_EQ(asset.scene_name, "small");
  EXPECT_EQ(asset.levels[0].positions[1], Vec3f(1, 0, 0));
  EXPECT_EQ(asset.levels[0].tangents[2].w, -1);
  EXPECT_EQ(asset.levels[0].triangles[0], (std::array<VertexId, 3>{0, 1, 2}));
  ASSERT_EQ(asset.textures.size(), 1U);
  EXPECT_EQ(asset.textures[0].width, fixtures::flat_normal_map().layout.width);
  EXPECT_EQ(asset.textures[0].bits, 8);
  EXPECT_FLOAT_EQ(asset.textures[0].pixels[2], 1);
  EXPECT_EQ(asset.materials[0].texture(MaterialSlot::kNormal), 0);
  EXPECT_EQ(recognise_file(folder_ / "a.glb"), FileKind::kAsset);
}

TEST_F(AssetFiles, StandAtRestWhereTheirNodesDo) {
  tinygltf::Model model = small_asset();
  for (tinygltf::Node& node : model.nodes) node.matrix = {1, 0, 0, 0, 0, -2, 0, 0, 0, 0, 1, 0, 3, 0, 0, 1};
  write_glb(folder_ / "a.glb", model);
  const AssetLevel own = read_asset(folder_ / "a.glb").levels.at(0);
  const AssetLevel shown = at_rest(own);
  EXPECT_EQ(own.positions[1], Vec3f(1, 0, 0));
  EXPECT_EQ(shown.positions[1], Vec3f(4, 0, 0));
  EXPECT_EQ(shown.triangles[0], (std::array<VertexId, 3>{0, 2, 1})) << "it is mirrored";
  EXPECT_EQ(shown.tangents[2].w, 1);
}

TEST_F(AssetFiles, AreRefusedWhereTheyAreNotOurs) {
  EXPECT_EQ(code_after([](tinygltf::Model&) {}), ExitCode::kDone);
  EXPECT_EQ(code_after([](tinygltf::Model& m) {
              m.nodes[0].translation = {1, 0, 0};
            }),
            ExitCode::kUnusableInput)
      << "one of its levels elsewhere";
  EXPECT_EQ(code_after([](tinygltf::Model& m) { m.scenes[0].nodes = {0, 1}; }), ExitCode::kUnsupported);
  EXPECT_EQ(code_after([](tinygltf::Model& m) { m.meshes[0].primitives[0].mode = TINYGLTF_MODE_LINE; }),
            ExitCode::kUnsupported);
}

TEST_F(AssetFiles, AreRefusedWhereTheyAreBroken) {
  const auto lod = [](tinygltf::Value ids) {
    return [ids](tinygltf::Model& m) {
      m.nodes[0].extensions["MSFT_lod"] = tinygltf::Value(tinygltf::Value::Object{{"ids", ids}});
    };
  };
  EXPECT_EQ(code_after(lod(tinygltf::Value(7))), ExitCode::kUnusableInput);
  EXPECT_EQ(code_after(lod(tinygltf::Value(tinygltf::Value::Array{tinygltf::Value(99)}))), ExitCode::kUnusableInput);
  EXPECT_EQ(code_after(lod(tinygltf::Value(tinygltf::Value::Array{tinygltf::Value(std::string("x"))}))),
            ExitCode::kUnusableInput);
  EXPECT_EQ(code_after([](tinygltf::Model& m) {
              // Not a PNG any more.
              const auto& view = m.bufferViews[m.images[0].bufferView];
              for (std::size_t i = 0; i < view.byteLength; ++i) m.buffers[0].data[view.byteOffset + i] = 7;
            }),
            ExitCode::kUnusableInput);
  EXPECT_EQ(code_after([](tinygltf::Model& m) { m.textures[0].source = -1; }), ExitCode::kUnusableInput);
  EXPECT_EQ(code_after([](tinygltf::Model& m) {
              m.meshes[0].primitives[0].attributes["NORMAL"] = m.meshes[0].primitives[0].attributes["TEXCOORD_0"];
            }),
            ExitCode::kUnusableInput);
}

TEST_F(AssetFiles, EveryKindOfFileIsRecognisedUnderAnyName) {
  const auto [mesh, map] = fixtures::subdivided_sphere(fixtures::octahedron(), 3);
  const auto kind_of = [&](const char* name, const char* alias) {
    std::filesystem::copy_file(folder_ / name, folder_ / alias, std::filesystem::copy_options::overwrite_existing);
    return recognise_file(folder_ / alias);
  };
  write_source_mesh(folder_ / "m.glb", mesh);
  EXPECT_EQ(kind_of("m.glb", "1"), FileKind::kSourceMesh);
  write_parameterization(folder_ / "p.glb", mesh, map);
  EXPECT_EQ(kind_of("p.glb", "2.png"), FileKind::kParameterization);
  write_patch_set(folder_ / "s.exr", fixtures::sphere_patches(fixtures::octahedron(), 2));
  EXPECT_EQ(kind_of("s.exr", "3.glb"), FileKind::kPatchSet);
  write_geometry_image(folder_ / "g.exr", fixtures::sphere_image(fixtures::octahedron(), 2));
  EXPECT_EQ(kind_of("g.exr", "4.json"), FileKind::kGeometryImage);
  EXPECT_EQ(kind_of("g.json", "5.exr"), FileKind::kGeometryImageJson);
  write_map(folder_ / "n.png", fixtures::flat_normal_map(), 8);
  EXPECT_EQ(kind_of("n.png", "6"), FileKind::kMapPng);
  write_map(folder_ / "n.exr", fixtures::flat_normal_map(), 32);
  EXPECT_EQ(kind_of("n.exr", "7"), FileKind::kMapExr);
}

TEST_F(AssetFiles, WhatIsNoneOfOursIsRefused) {
  for (const std::string& text :
       std::vector<std::string>{"", "hello", "{", "{}", "{\"a\": 1}", "glTF", "\x76\x2f\x31\x01"}) {
    std::ofstream(folder_ / "x", std::ios::binary) << text;
    try {
      recognise_file(folder_ / "x");
      FAIL() << text;
    } catch (const Error& e) {
      EXPECT_EQ(e.code(), ExitCode::kUnusableInput) << text;
    }
  }
  EXPECT_THROW(recognise_file(folder_ / "not there"), Error);
}

}  // namespace
}  // namespace lozenge
