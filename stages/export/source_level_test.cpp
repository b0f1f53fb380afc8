// Assets whose finest level is the source's own triangles, read back.
#include <gtest/gtest.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>

#include "formats/base/error.h"
#include "formats/base/file_fixtures.h"
#include "formats/domain/sphere_fixtures.h"
#include "formats/files/asset_file.h"
#include "formats/files/readers/gltf/model.h"
#include "formats/patches/tangent_frame.h"
#include "stages/export/engine_mesh.h"
#include "stages/export/export.h"
#include "stages/export/export_fixtures.h"

namespace lozenge {
namespace {

/// The octahedron's sphere: its source, its map, and patches of it.
struct Ball {
  SourceMesh mesh;
  Parameterization map;
  GeometryImage image;
  SourceSurface source() const { return {&mesh, &map}; }
};

Ball ball(int n, std::int32_t samples) {
  Ball made;
  const Domain domain = fixtures::octahedron();
  std::tie(made.mesh, made.map) = fixtures::subdivided_sphere(domain, n);
  std::vector<Vec3d> places(static_cast<std::size_t>(domain.vertex_count));
  for (std::size_t v = 0; v < made.mesh.positions.size(); ++v) {
    const DomainVertex at = vertex_at(domain, made.map.phi[v]);
    if (at >= 0) places[at] = Vec3d(made.mesh.positions[v]);
  }
  made.image = export_fixtures::sphere(domain, places, samples);
  return made;
}

class AssetOfSource : public testing::Test {
 protected:
  AssetFacts write(const Ball& ball, const BakedMaps& maps, const ExportOptions& options) {
    const SourceSurface source = ball.source();
    return export_asset(folder_ / "ball.glb", ball.image, maps, options, &source);
  }
  Asset read() const { return read_asset(folder_ / "ball.glb"); }

  fixtures::TestFolder folder_;
};

TEST_F(AssetOfSource, IsLightestFirstWhereThatIsTheSource) {
  const Ball fine = ball(6, 33);  // 8 * 36 source triangles, 12 * 2 * 32 * 32 of samples
  EXPECT_EQ(write(fine, {}, {}).source_triangles, write(fine, {}, {}).triangles);
  EXPECT_EQ(write(fine, {}, {.finest = Finest::kSamples}).source_triangles, 0);
  EXPECT_EQ(write(fine, {}, {.samples = 17}).source_triangles, 0) << "who asks for samples gets them";
  const Ball coarse = ball(30, 5);  // 8 * 900 of the source, 12 * 2 * 16 of samples
  EXPECT_EQ(write(coarse, {}, {}).source_triangles, 0);
  EXPECT_GT(write(coarse, {}, {.finest = Finest::kSource}).source_triangles, 8 * 900);
}

TEST_F(AssetOfSource, HasOnlyLighterLevelsBehindIt) {
  write(ball(10, 33), {}, {.max_coarser_levels = 9});
  const Asset asset = read();
  ASSERT_GT(asset.levels.size(), 2U);
  EXPECT_EQ(asset.source_triangles, static_cast<std::int32_t>(asset.levels.front().triangles.size()));
  for (std::size_t l = 1; l < asset.levels.size(); ++l) {
    EXPECT_LT(asset.levels[l].triangles.size(), asset.levels[l - 1].triangles.size());
  }
}

TEST_F(AssetOfSource, KeepsItsTrianglesOnEachLevelWhereNoOtherIsLighter) {
  const Ball box = ball(1, 17);  // 8 triangles, cut into 24: as many as the coarsest samples give
  write(box, {}, {});
  EXPECT_EQ(read().levels.size(), 1U);
}

TEST_F(AssetOfSource, HasANormalMapOnResampledTrianglesAlone) {
  const Ball made = ball(10, 33);
  write(made, export_fixtures::maps(made.image, 256, 0), {});
  const Asset asset = read();
  ASSERT_GT(asset.levels.size(), 1U);
  EXPECT_LT(asset.materials.at(asset.levels[0].material_of(0)).texture(MaterialSlot::kNormal), 0);
  EXPECT_GE(asset.materials.at(asset.levels[0].material_of(0)).texture(MaterialSlot::kOcclusion), 0);
  EXPECT_GE(asset.materials.at(asset.levels[1].material_of(0)).texture(MaterialSlot::kNormal), 0);
}

TEST_F(AssetOfSource, HasANormalMapOfEachResampledLevelHalfTheSizeOfTheOneBefore) {
  const Ball made = ball(30, 9);
  write(made, export_fixtures::maps(made.image, 256, 0), {.finest = Finest::kSamples, .max_coarser_levels = 2});
  const Asset asset = read();
  ASSERT_EQ(asset.levels.size(), 3U);
  std::vector<std::int32_t> widths;
  for (const AssetLevel& level : asset.levels) {
    const std::int32_t texture = asset.materials.at(level.material_of(0)).texture(MaterialSlot::kNormal);
    ASSERT_GE(texture, 0);
    widths.push_back(asset.textures.at(texture).width);
  }
  // The fixture's gutter is of two texels, of which the smallest map keeps half of one: look-ups in patches stay there.
  EXPECT_EQ(widths, (std::vector<std::int32_t>{256, 128, 64}));
}

TEST_F(AssetOfSource, ShowsOnEachLevelTheNormalsThatItsMapWasBakedWith) {
  const Ball made = ball(30, 9);
  BakedMaps maps = export_fixtures::maps(made.image, 256, 0);
  // Flat everywhere: the sphere's own normals.
  for (std::size_t t = 0; t < maps.maps[0].texels.size(); t += 3) {
    maps.maps[0].texels[t] = maps.maps[0].texels[t + 1] = 0;
    maps.maps[0].texels[t + 2] = 1;
  }
  write(made, maps, {.finest = Finest::kSamples});
  const Asset asset = read();
  for (const AssetLevel& level : asset.levels) {
    for (std::size_t t = 0; t < level.triangles.size(); ++t) {
      Vec3d middle(0, 0, 0);
      for (const VertexId v : level.triangles[t]) middle += Vec3d(level.positions[v]);
      const Vec3f normal = mapped_normal(asset, level, static_cast<TriangleId>(t), Vec3d(1, 1, 1) / 3);
      EXPECT_GT(Vec3d(normal).dot(middle.normalized()), 0.999) << level.triangles.size();
    }
  }
}

TEST_F(AssetOfSource, HasTheBudgetOfTrianglesOnItsFinestLevelWhateverTheSamples) {
  const Ball made = ball(30, 9);  // 7,200 triangles, and 1,536 of samples
  for (const std::int64_t budget : {5000, 1000, 100, 12}) {
    const AssetFacts facts = write(made, export_fixtures::maps(made.image, 256, 0), {.triangle_budget = budget});
    EXPECT_LE(facts.triangles, budget);
    EXPECT_GE(facts.triangles, budget - 1) << "a collapse takes two";
    EXPECT_TRUE(facts.note.empty()) << facts.note;
    const Asset asset = read();
    for (std::size_t l = 1; l < asset.levels.size(); ++l) EXPECT_GE(asset.levels[l].triangles.size(), 200U);
  }
  EXPECT_NE(write(made, {}, {.triangle_budget = 1}).note.find("4 triangles instead of at most 1"), std::string::npos);
}

TEST_F(AssetOfSource, KnowsHowFarItsLevelsAreFromTheSourceAndItsCoarserOnesAreFarther) {
  const Ball made = ball(30, 9);
  const AssetFacts facts = write(made, export_fixtures::maps(made.image, 256, 0), {.max_coarser_levels = 3});
  ASSERT_EQ(facts.level_qualities.size(), 4U);
  const Asset asset = read();
  for (std::size_t l = 0; l < 4; ++l) {
    const LevelQuality& level = facts.level_qualities[l];
    EXPECT_EQ(level.triangles, facts.level_triangles[l]);
    EXPECT_EQ(level.vertices, static_cast<std::int64_t>(asset.levels[l].positions.size()));
    ASSERT_TRUE(level.mean_distance_percent && level.max_distance_percent && level.normal_angle);
    EXPECT_GE(*level.max_distance_percent, *level.mean_distance_percent);
    if (l == 0) continue;
    EXPECT_GT(*level.mean_distance_percent, *facts.level_qualities[l - 1].mean_distance_percent);
  }
}

TEST_F(AssetOfSource, GivesWayToCoarserLevelsWhereTheyAreOffByTwoPixels) {
  const Ball made = ball(30, 9);
  const AssetFacts facts = write(made, {}, {.max_coarser_levels = 2});
  const GltfFile gltf = open_gltf(folder_ / "ball.glb");
  const tinygltf::Value& coverages = gltf.model->nodes[0].extras.Get("MSFT_screencoverage");
  ASSERT_EQ(coverages.ArrayLen(), 3U);
  for (int l = 0; l < 2; ++l) {
    const double off = *facts.level_qualities[static_cast<std::size_t>(l) + 1].max_distance_percent / 100;
    const double diagonal = 2 / off;  // pixels
    const double share = diagonal * diagonal / 2 / (1920.0 * 1080.0);
    EXPECT_NEAR(coverages.Get(l).GetNumberAsDouble(), std::min(1.0, share), 1e-6) << l;
  }
  EXPECT_EQ(coverages.Get(2).GetNumberAsDouble(), 0);
}

TEST_F(AssetOfSource, SaysWhatItNeedsWhereTheSourceIsUnknown) {
  const Ball made = ball(3, 5);
  try {
    export_asset(folder_ / "x.glb", made.image, {}, {.finest = Finest::kSource});
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::kUsage);
    EXPECT_NE(std::string(error.what()).find("--source"), std::string::npos);
  }
  const Ball other = ball(3, 5);
  auto [mesh, map] = fixtures::subdivided_sphere(fixtures::icosahedron(), 3);
  const SourceSurface wrong{&mesh, &map};
  EXPECT_THROW(export_asset(folder_ / "x.glb", other.image, {}, {.finest = Finest::kSource}, &wrong), Error);
}

TEST_F(AssetOfSource, HasTangentsThatPointAlongTheAtlas) {
  write(ball(10, 33), {}, {.coarser_levels = false});
  const AssetLevel level = read().levels.at(0);
  for (const auto& t : level.triangles) {
    const Vec2d b = Vec2d(level.uvs[t[1]]) - Vec2d(level.uvs[t[0]]);
    const Vec2d c = Vec2d(level.uvs[t[2]]) - Vec2d(level.uvs[t[0]]);
    const Vec3d e(level.positions[t[1]] - level.positions[t[0]]);
    const Vec3d f(level.positions[t[2]] - level.positions[t[0]]);
    if (!(b.cross(c) > 1e-7)) continue;
    const Vec3d along_u = (e * c.y - f * b.y).normalized();
    for (const VertexId v : t) {
      const Vec4f& tangent = level.tangents[v];
      EXPECT_EQ(tangent.w, kBitangentSign);
      // The sphere's map bends, but not by much within a triangle of a tenth of the domain's.
      EXPECT_GT(along_u.dot(Vec3d(tangent.x, tangent.y, tangent.z)), 0.7);
    }
  }
}

}  // namespace
}  // namespace lozenge
