// Every file is what assets.h says, seen through the importer.
#include "test_assets/assets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "formats/base/error.h"
#include "formats/surface/attribute_fixtures.h"
#include "stages/import/import_surface.h"
#include "stages/import/surface.h"
#include "test_assets/shape.h"

namespace lozenge::test_assets {
namespace {

std::filesystem::path path_of(std::string_view file) { return std::filesystem::path(LOZENGE_TEST_ASSETS) / file; }

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

/// "bad/open_surface.glb" -> "bad_open_surface_glb"
template <typename T>
std::string test_name(const testing::TestParamInfo<T>& info) {
  std::string name(info.param.file);
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
  return name;
}

/// That the importer makes of the file the surface that its entry says, with the repairs that it says.
void expect_imported(const Asset& asset) {
  ImportReport report;
  const SourceMesh mesh = import_surface(path_of(asset.file), {}, {}, &report);
  const SurfaceFacts facts = require_manifold(mesh, std::string(asset.file));
  EXPECT_EQ(facts.triangles, asset.triangles);
  EXPECT_EQ(facts.components, asset.components);
  EXPECT_EQ(facts.euler, asset.euler);
  EXPECT_EQ(facts.boundary_loops, asset.boundary_loops);
  for (std::size_t k = 0; k < kRepairKinds; ++k) {
    const auto kind = static_cast<RepairKind>(k);
    std::int64_t expected = 0;
    for (const ExpectedRepair& repair : asset.repairs) expected += repair.key == key_of(kind) ? repair.count : 0;
    EXPECT_EQ(report.repairs[kind].count, expected) << key_of(kind);
  }
}

class GoodAsset : public testing::TestWithParam<Asset> {};

TEST_P(GoodAsset, IsTheClosedSurfaceThatItsEntrySays) {
  ASSERT_EQ(GetParam().boundary_loops, 0);
  expect_imported(GetParam());
}

TEST_P(GoodAsset, FacesOutwards) {
  const SourceMesh mesh = import_asset(path_of(GetParam().file));
  EXPECT_GT(signed_volume({mesh.positions, mesh.triangles}), 0);
}

std::vector<Asset> good_assets() {
  std::vector<Asset> assets(kAssets.begin(), kAssets.end());
  assets.push_back(kShowpiece);
  return assets;
}
INSTANTIATE_TEST_SUITE_P(TestAssets, GoodAsset, testing::ValuesIn(good_assets()), test_name<Asset>);

class RepairedAsset : public testing::TestWithParam<Asset> {};

TEST_P(RepairedAsset, IsClosedOnceItIsRepairedAndRefusedWhereNoRepairIsAllowed) {
  ASSERT_EQ(GetParam().boundary_loops, 0);
  expect_imported(GetParam());
  EXPECT_THROW(import_surface(path_of(GetParam().file), {.strict = true}), Error);
}
INSTANTIATE_TEST_SUITE_P(TestAssets, RepairedAsset, testing::ValuesIn(kRepairedAssets), test_name<Asset>);

class OpenAsset : public testing::TestWithParam<Asset> {};

TEST_P(OpenAsset, EndsInAsManyLoopsAsItsEntrySays) {
  ASSERT_GT(GetParam().boundary_loops, 0);
  expect_imported(GetParam());
}
INSTANTIATE_TEST_SUITE_P(TestAssets, OpenAsset, testing::ValuesIn(kOpenAssets), test_name<Asset>);

class BadAssetFile : public testing::TestWithParam<BadAsset> {};

TEST_P(BadAssetFile, IsRefusedWithItsCodeAndItsWord) {
  const BadAsset& asset = GetParam();
  try {
    require_manifold(import_surface(path_of(asset.file)), std::string(asset.file));
    FAIL() << "was accepted";
  } catch (const Error& error) {
    EXPECT_EQ(static_cast<int>(error.code()), asset.exit_code) << error.what();
    EXPECT_NE(lower(error.what()).find(asset.word), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find(path_of(asset.file).filename().string()), std::string::npos)
        << error.what();
  }
}
INSTANTIATE_TEST_SUITE_P(TestAssets, BadAssetFile, testing::ValuesIn(kBadAssets), test_name<BadAsset>);

TEST(SeamsAsset, IsTheSameSurfaceWithItsBufferInsideAndOutside) {
  const SourceMesh inside = import_asset(path_of("seams.glb"));
  const SourceMesh outside = import_asset(path_of("seams.gltf"));
  EXPECT_EQ(inside.positions, outside.positions);
  EXPECT_EQ(inside.triangles, outside.triangles);
  EXPECT_EQ(fixtures::corner_uvs(inside), fixtures::corner_uvs(outside));
  EXPECT_EQ(inside.materials, outside.materials);
  EXPECT_EQ(inside.material_names.size(), 3U);
}

TEST(WormAsset, StandsTwoMetresHighOnItsBones) {
  const SourceMesh mesh = import_asset(path_of("worm.glb"));
  std::vector<Vec3f> worm;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const std::int32_t body = mesh.bodies.owner_of(mesh.materials[t]);
    if (body < 0 || mesh.bodies.bodies[body].skin < 0) continue;
    for (const VertexId v : mesh.triangles[t]) worm.push_back(mesh.positions[v]);
  }
  const Bounds bounds = bounds_of(worm);
  EXPECT_LT((bounds.low - Vec3f(-0.3F, 0, -0.3F)).length(), 1e-5F);
  EXPECT_LT((bounds.high - Vec3f(0.3F, 2, 0.3F)).length(), 1e-5F);
  EXPECT_EQ(mesh.bodies.bodies.size(), 2U) << "the skin and the hat";
  EXPECT_EQ(mesh.rig.nodes.size(), 5U);
}

TEST(CartAsset, IsOneBodyForEachNodeThatMoves) {
  const SourceMesh mesh = import_asset(path_of("cart.glb"));
  std::vector<std::string> names;
  for (const Body& body : mesh.bodies.bodies) names.push_back(body.name);
  EXPECT_EQ(names, (std::vector<std::string>{"Left wheel", "Seat"}));
  ASSERT_EQ(mesh.bodies.bodies[0].places.size(), 2U) << "the right wheel is another place of the left one";
  EXPECT_TRUE(is_mirroring(mesh.bodies.bodies[0].places[1].placement));
  EXPECT_EQ(mesh.rig.animations.size(), 3U) << "the one that stays is left out";
}

TEST(FaceAsset, KeepsTheTargetsThatDoSomethingWithTheirNamesAndWeights) {
  const SourceMesh mesh = import_asset(path_of("face.glb"));
  ASSERT_EQ(mesh.bodies.bodies.size(), 1U);
  const Body& face = mesh.bodies.bodies[0];
  EXPECT_EQ(face.name, "Face");
  EXPECT_EQ(face.targets, (std::vector<MorphTarget>{{"grin", 0}, {"wink", 0.25}}));
  ASSERT_EQ(mesh.rig.animations.size(), 1U);
  const Animation& laugh = mesh.rig.animations[0];
  EXPECT_EQ(laugh.channels.at(0).path, ChannelPath::kWeights);
  EXPECT_EQ(laugh.channels.at(0).node, face.places.at(0).node);
  EXPECT_EQ(laugh.samplers.at(0).values, (std::vector<float>{0, 0.25F, 1, 0, 0.5F, 1}))
      << "without those of the idle one";
  const AttributeStream* grin = find_stream(mesh.corner_attributes, kMorphOffsets, 0);
  const AttributeStream* wink = find_stream(mesh.corner_attributes, kMorphOffsets, 1);
  ASSERT_TRUE(grin != nullptr && wink != nullptr);
  EXPECT_NE(find_stream(mesh.corner_attributes, kMorphNormals, 0), nullptr);
  EXPECT_EQ(find_stream(mesh.corner_attributes, kMorphNormals, 1), nullptr);
  // The node turns x to y, and its parent halves z and lifts all by 1.
  for (std::size_t c = 0; c < 3 * mesh.triangles.size(); ++c) {
    const bool moves = mesh.bodies.owner_of(mesh.materials[c / 3]) == 0;
    const Vec3f p = mesh.positions[mesh.triangles[c / 3][c % 3]] - Vec3f(0, 1, 0);
    const float z = 2 * p.z;
    const float depth = std::max(0.0F, (p.y - 0.5F) * 0.5F);
    const Vec3f up(0, 0, moves && z > 0 ? 0.5F * z * z : 0);
    const Vec3f in(0, moves ? -depth : 0, 0);
    EXPECT_LT((vector_at<Vec3f>(*grin, c) - up).length(), 1e-6F) << c;
    EXPECT_LT((vector_at<Vec3f>(*wink, c) - in).length(), 1e-6F) << c;
  }
}

TEST(PackedWormsAsset, StandsAsItsBonesSayInWhateverNumbersItIsWritten) {
  const SourceMesh mesh = import_asset(path_of("packed_worms.glb"));
  ASSERT_EQ(mesh.bodies.bodies.size(), 3U) << "one for each skin";
  EXPECT_EQ(mesh.rig.nodes.size(), 7U) << "those that are in no scene, too";
  EXPECT_EQ(mesh.rig.animations.size(), 2U);
  std::array<std::vector<Vec3f>, 3> worms;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (const VertexId v : mesh.triangles[t]) {
      worms[static_cast<std::size_t>(mesh.bodies.owner_of(mesh.materials[t]))].push_back(mesh.positions[v]);
    }
  }
  constexpr float kStep = 0.01F / 64;  // of the whole numbers
  for (std::size_t w = 0; w < worms.size(); ++w) {
    const Bounds bounds = bounds_of(worms[w]);
    EXPECT_NEAR(bounds.low.y, 0, kStep) << w;
    // The head's joint is 40 + 0.75 * 40 centimetres high, and what is 20 above it is 15.
    EXPECT_NEAR(bounds.high.y, w < 2 ? 0.85F : 1, kStep) << w;
  }
  // The bone that is half as wide again makes the first worm thicker, and takes the second one, which stands beside it,
  // away from it.
  EXPECT_LT(bounds_of(worms[0]).low.x, -0.16F);
  EXPECT_GT(bounds_of(worms[1]).high.x, 0.9F);
  EXPECT_NEAR(bounds_of(worms[2]).low.x, -0.75F, kStep);
  const AttributeStream* influences = find_stream(mesh.corner_attributes, kInfluences);
  ASSERT_NE(influences, nullptr);
  for (std::size_t c = 0; c < influences->count(); ++c) {
    EXPECT_TRUE(is_influence(influences->at(c)) && !is_unmoved(influences->at(c)));
  }
}

TEST(CubeAsset, KeepsTheNormalsOfItsFacesWhereTheirVerticesAreWelded) {
  const SourceMesh mesh = import_asset(path_of("cube.glb"));
  EXPECT_EQ(mesh.positions.size(), 3072U / 2 + 2);  // Euler's formula
  for (std::size_t c = 0; c < fixtures::corner_normals(mesh).size(); ++c) {
    const auto& [p, q, r] = mesh.triangles[c / 3];
    const Vec3f face = (mesh.positions[q] - mesh.positions[p]).cross(mesh.positions[r] - mesh.positions[p]);
    EXPECT_EQ(fixtures::corner_normals(mesh)[c], face.normalized());
  }
}

TEST(Description, ListsEveryFileThatThereIs) {
  std::ifstream stream(path_of("assets.json"));
  const auto description = nlohmann::json::parse(stream);
  std::size_t listed = 0;
  for (const char* list : {"assets", "repaired", "open", "bad"}) {
    for (const auto& entry : description[list]) {
      EXPECT_TRUE(std::filesystem::is_regular_file(path_of(entry["file"].get<std::string>()))) << entry;
      ++listed;
    }
  }
  EXPECT_EQ(listed, kAssets.size() + kRepairedAssets.size() + kOpenAssets.size() + kBadAssets.size());
  EXPECT_TRUE(std::filesystem::is_regular_file(path_of(description["showpiece"]["file"].get<std::string>())));
}

}  // namespace
}  // namespace lozenge::test_assets
