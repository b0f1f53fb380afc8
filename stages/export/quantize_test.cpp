#include "stages/export/quantize.h"

#include <gtest/gtest.h>
#include <tiny_gltf.h>

#include <cstring>
#include <map>

#include "formats/base/file_fixtures.h"
#include "formats/files/asset_file.h"
#include "formats/files/asset_places.h"
#include "formats/files/gltf_writer.h"
#include "formats/surface/boundary.h"
#include "formats/surface/mesh_statistics.h"
#include "stages/export/export.h"
#include "stages/export/export_fixtures.h"

namespace lozenge {
namespace {

constexpr ExportOptions kQuantized{.vertex_format = VertexFormat::kQuantized};
constexpr ExportOptions kCompressed{.vertex_format = VertexFormat::kQuantized, .compression = Compression::kMeshopt};

class QuantizedAsset : public testing::Test {
 protected:
  Asset exported(const GeometryImage& image, const BakedMaps& maps, const ExportOptions& options) {
    export_asset(folder_ / "ball.glb", image, maps, options);
    return read_asset(folder_ / "ball.glb");
  }
  std::uintmax_t size() const { return std::filesystem::file_size(folder_ / "ball.glb"); }

  fixtures::TestFolder folder_;
};

/// Two balls of which the second is placed twice.
GeometryImage two_balls() {
  GeometryImage image = export_fixtures::two_spheres(9);
  image.layout.bodies.bodies = {{"bead", {{}, {{0, 2, 0, 0, -2, 0, 0, 0, 0, 0, 3, 0, 5, 0, 0, 1}, -1}}, -1}};
  for (const PatchPlace& place : image.layout.places)
    image.layout.bodies.owner.push_back(place.left.triangle < 8 ? -1 : 0);
  return image;
}

TEST_F(QuantizedAsset, IsTheSameToAStepOfItsIntegersInAllPlaces) {
  const GeometryImage image = two_balls();
  const BakedMaps maps = export_fixtures::maps(image, 256, 0);
  for (const LodsAs lods_as : {LodsAs::kMsftLod, LodsAs::kNodes}) {
    ExportOptions options = kQuantized;
    options.lods_as = lods_as;
    const Asset plain = exported(image, maps, {});
    const Asset asset = exported(image, maps, options);
    EXPECT_NEAR(asset.rounding.position, 3 * 2 / 65535.0 / 2, 5e-6) << "a copy is three times as large";
    ASSERT_EQ(asset.levels.size(), plain.levels.size());
    for (std::size_t l = 0; l < asset.levels.size(); ++l) {
      const AssetLevel here = with_copies(asset.levels[l]);
      const AssetLevel there = with_copies(plain.levels[l]);
      EXPECT_EQ(here.triangles, there.triangles);
      ASSERT_EQ(here.positions.size(), there.positions.size());
      for (std::size_t v = 0; v < here.positions.size(); ++v) {
        EXPECT_LT((here.positions[v] - there.positions[v]).length(), 2e-4);
        EXPECT_GT(here.normals[v].dot(there.normals[v]), 0.9999F);
        EXPECT_LT((here.uvs[v] - there.uvs[v]).length(), 1.5 / 65535);
        EXPECT_EQ(here.tangents[v].w, there.tangents[v].w);
      }
    }
  }
}

TEST_F(QuantizedAsset, IsClosedOnceEqualPositionsAreWelded) {
  for (const AssetLevel& level : exported(export_fixtures::octahedron(17), {}, kCompressed).levels) {
    const auto welded = renumbered(level.triangles, welded_vertices(level.positions));
    const MeshStatistics statistics = mesh_statistics({level.positions, welded});
    EXPECT_TRUE(is_closed_manifold(statistics));
    EXPECT_EQ(statistics.euler, 2);
  }
}

TEST_F(QuantizedAsset, HoldsTheSameCompressedInFewerBytes) {
  const GeometryImage image = two_balls();
  const BakedMaps maps = export_fixtures::maps(image, 64, 0);
  for (const VertexFormat format : {VertexFormat::kFloat, VertexFormat::kQuantized}) {
    const Asset loose = exported(image, maps, {.vertex_format = format});
    const std::uintmax_t before = size();
    const Asset packed = exported(image, maps, {.vertex_format = format, .compression = Compression::kMeshopt});
    EXPECT_LT(size(), before);
    ASSERT_EQ(packed.levels.size(), loose.levels.size());
    for (std::size_t l = 0; l < packed.levels.size(); ++l) {
      EXPECT_EQ(packed.levels[l].positions, loose.levels[l].positions);
      EXPECT_EQ(packed.levels[l].normals, loose.levels[l].normals);
      EXPECT_EQ(packed.levels[l].uvs, loose.levels[l].uvs);
      EXPECT_EQ(packed.levels[l].triangles.size(), loose.levels[l].triangles.size());
    }
  }
}

TEST_F(QuantizedAsset, NeedsItsExtensionsToBeUnderstood) {
  exported(export_fixtures::octahedron(9), {}, kCompressed);
  const std::string glb = fixtures::bytes_of(folder_ / "ball.glb");
  const auto required = glb.find("extensionsRequired");
  ASSERT_NE(required, std::string::npos);
  EXPECT_NE(glb.find("KHR_mesh_quantization", required), std::string::npos);
  EXPECT_NE(glb.find("EXT_meshopt_compression", required), std::string::npos);
}

/// A triangle of these corners, as floats.
tinygltf::Model triangle(const std::vector<float>& positions) {
  tinygltf::Model model;
  GltfBuffer buffer(model);
  tinygltf::Primitive& primitive = model.meshes.emplace_back().primitives.emplace_back();
  primitive.attributes["POSITION"] = buffer.add_floats(positions, 3, true);
  return model;
}

std::vector<std::uint16_t> positions_of(const tinygltf::Model& model) {
  const tinygltf::BufferView& view = model.bufferViews[0];
  std::vector<std::uint16_t> values(view.byteLength / 2);
  std::memcpy(values.data(), model.buffers[0].data.data() + view.byteOffset, view.byteLength);
  return values;
}

TEST(QuantizeVertices, GivesAMovingNodesMeshToAChildOfIt) {
  tinygltf::Model model = triangle({1, 2, 3, 5, 2, 3, 1, 4, 3});
  model.nodes.emplace_back().mesh = 0;
  tinygltf::AnimationChannel& channel = model.animations.emplace_back().channels.emplace_back();
  channel.target_node = 0;
  channel.target_path = "rotation";
  quantize_vertices(model, {{0, 1}});
  ASSERT_EQ(model.nodes.size(), 2U);
  EXPECT_EQ(model.nodes[0].mesh, -1);
  EXPECT_TRUE(model.nodes[0].scale.empty());
  EXPECT_EQ(model.nodes[0].children, std::vector<int>{1});
  EXPECT_EQ(model.nodes[1].translation, (std::vector<double>{1, 2, 3}));
  EXPECT_EQ(model.nodes[1].scale, (std::vector<double>{4, 4, 4}));
  EXPECT_EQ(positions_of(model), (std::vector<std::uint16_t>{0, 0, 0, 0, 65535, 0, 0, 0, 0, 32768, 0, 0}));
}

TEST(QuantizeVertices, KeepsTheTransformOfANodeThatStandsStill) {
  tinygltf::Model model = triangle({1, 2, 3, 5, 2, 3, 1, 4, 3});
  model.nodes.resize(3);
  for (tinygltf::Node& node : model.nodes) node.mesh = 0;
  model.nodes[0].translation = {10, 0, 0};
  model.nodes[1].rotation = {0, 0, 1, 0};
  model.nodes[2].matrix = {2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 10, 0, 0, 1};
  quantize_vertices(model, {{0, 1}});
  EXPECT_EQ(model.nodes[0].translation, (std::vector<double>{11, 2, 3}));
  EXPECT_EQ(model.nodes[0].scale, (std::vector<double>{4, 4, 4}));
  EXPECT_EQ(model.nodes[1].rotation, (std::vector<double>{0, 0, 1, 0}));
  ASSERT_EQ(model.nodes[1].children, std::vector<int>{3});
  EXPECT_EQ(model.nodes[3].translation, (std::vector<double>{1, 2, 3}));
  EXPECT_EQ(model.nodes[2].matrix, (std::vector<double>{8, 0, 0, 0, 0, 8, 0, 0, 0, 0, 8, 0, 12, 4, 6, 1}));
}

TEST(QuantizeVertices, KeepsDifferentPositionsDifferentAndEqualOnesEqual) {
  tinygltf::Model model = triangle({0, 0, 0, 1, 1, 1, 1e-7F, 0, 0, 2e-7F, 0, 0, 0, 0, 0});
  model.nodes.emplace_back().mesh = 0;
  quantize_vertices(model, {{0, 1}});
  const std::vector<std::uint16_t> values = positions_of(model);
  std::map<std::vector<std::uint16_t>, int> places;
  for (std::size_t v = 0; v < 5; ++v) ++places[{values[4 * v], values[4 * v + 1], values[4 * v + 2]}];
  EXPECT_EQ(places.size(), 4U);
  EXPECT_EQ((places[{0, 0, 0}]), 2);
}

}  // namespace
}  // namespace lozenge
