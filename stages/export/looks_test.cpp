// What can't be one material comes out as primitives of their own, over the same atlas.
#include "stages/export/looks.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "formats/base/file_fixtures.h"
#include "formats/domain/sphere_fixtures.h"
#include "formats/files/asset_file.h"
#include "stages/export/export_fixtures.h"

namespace lozenge {
namespace {

/// A sphere of the octahedron: opaque above, a mask that is seen from both sides below, and glass in the east.
struct Ball {
  SourceMesh mesh;
  Parameterization map;
  GeometryImage image;
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
  made.mesh.material_names = {"glass", "stone", "leaf", "leaf of another name"};
  made.mesh.material_looks.resize(4);
  made.mesh.material_looks[0].alpha_mode = AlphaMode::kBlend;
  made.mesh.material_looks[2].alpha_mode = made.mesh.material_looks[3].alpha_mode = AlphaMode::kMask;
  made.mesh.double_sided = {false, false, true, true};
  int number = 0;
  for (const auto& [a, b, c] : made.mesh.triangles) {
    const Vec3f middle = (made.mesh.positions[a] + made.mesh.positions[b] + made.mesh.positions[c]) / 3;
    made.mesh.materials.push_back(middle.x > 0.6F ? 0 : middle.z > 0 ? 1 : 2 + number++ % 2);
  }
  return made;
}

double area_of(const AssetLevel& level, std::int32_t material) {
  double area = 0;
  for (std::size_t t = 0; t < level.triangles.size(); ++t) {
    if (level.material_of(static_cast<TriangleId>(t)) == material)
      area += triangle_area(level.positions, level.triangles[t]);
  }
  return area;
}

double area_of(const SourceMesh& mesh, const LookClasses& looks, std::int32_t look) {
  double area = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (looks.of(mesh, static_cast<TriangleId>(t)) == look) area += triangle_area(mesh.positions, mesh.triangles[t]);
  }
  return area;
}

class LooksOfAsset : public testing::Test {
 protected:
  Asset write(const Ball& ball, const ExportOptions& options, bool with_source = true) {
    const SourceSurface source{&ball.mesh, &ball.map};
    export_asset(folder_ / "ball.glb", ball.image, {}, options, with_source ? &source : nullptr);
    return read_asset(folder_ / "ball.glb");
  }

  fixtures::TestFolder folder_;
};

TEST(LookClasses, AreThoseThatDifferInMoreThanTextures) {
  const Ball made = ball(4, 5);
  const LookClasses looks = look_classes(made.mesh);
  ASSERT_EQ(looks.classes.size(), 3U);
  EXPECT_EQ(looks.classes[0], LookClass());
  EXPECT_EQ(looks.classes[1], (LookClass{AlphaMode::kMask, true, {}}));
  EXPECT_EQ(looks.classes[2], (LookClass{AlphaMode::kBlend, false, {}})) << "drawn last";
  EXPECT_EQ(looks.of_material, (std::vector<std::int32_t>{2, 0, 1, 1}));
  for (const LookClass& look : looks.classes) EXPECT_EQ(class_of_code(code_of(look)), look);
}

TEST_F(LooksOfAsset, OfTheSourceLevelAreExact) {
  const Ball made = ball(6, 33);
  const Asset asset = write(made, {.finest = Finest::kSource, .max_coarser_levels = 0});
  const LookClasses looks = look_classes(made.mesh);
  ASSERT_EQ(asset.materials.size(), 3U);
  for (std::int32_t look = 0; look < 3; ++look) {
    EXPECT_NEAR(area_of(asset.levels[0], look), area_of(made.mesh, looks, look), 1e-4) << look;
    EXPECT_EQ(asset.materials[look].double_sided, looks.classes[look].double_sided);
  }
}

TEST_F(LooksOfAsset, OfSamplesAreThoseOfMostOfATriangle) {
  const Ball made = ball(12, 17);
  const LookClasses looks = look_classes(made.mesh);
  const Asset asset = write(made, {.finest = Finest::kSamples, .max_coarser_levels = 1});
  ASSERT_EQ(asset.materials.size(), 3U);
  for (const AssetLevel& level : asset.levels) {
    for (std::int32_t look = 0; look < 3; ++look) {
      // A ragged border: half a triangle here and there.
      EXPECT_NEAR(area_of(level, look), area_of(made.mesh, looks, look), 0.25) << look;
    }
    double side = 0;  // the longest of a triangle
    for (const auto& [a, b, c] : level.triangles)
      side = std::max(side, double((level.positions[a] - level.positions[b]).length()));
    for (std::size_t t = 0; t < level.triangles.size(); ++t) {
      const auto& [a, b, c] = level.triangles[t];
      const Vec3f middle = (level.positions[a] + level.positions[b] + level.positions[c]) / 3;
      if (std::abs(middle.x - 0.6F) < side + 0.1 || std::abs(middle.z) < side + 0.1) continue;
      EXPECT_EQ(level.material_of(static_cast<TriangleId>(t)), middle.x > 0.6F ? 2 : middle.z > 0 ? 0 : 1);
    }
  }
}

TEST_F(LooksOfAsset, ThatAreBlendedKeepTheOrderOfTheSource) {
  const Ball made = ball(6, 33);
  const AssetLevel level = write(made, {.finest = Finest::kSource, .max_coarser_levels = 0}).levels[0];
  std::size_t last = 0;
  std::size_t steps_back = 0;
  for (std::size_t t = 0; t < level.triangles.size(); ++t) {
    if (level.material_of(static_cast<TriangleId>(t)) != 2) continue;
    const auto& [a, b, c] = level.triangles[t];
    const Vec3f middle = (level.positions[a] + level.positions[b] + level.positions[c]) / 3;
    std::size_t nearest = 0;
    float best = 1e9F;
    for (std::size_t s = 0; s < made.mesh.triangles.size(); ++s) {
      const auto& [i, j, k] = made.mesh.triangles[s];
      const float distance =
          ((made.mesh.positions[i] + made.mesh.positions[j] + made.mesh.positions[k]) / 3 - middle).length();
      if (distance < best) nearest = s;
      best = std::min(best, distance);
    }
    steps_back += nearest < last ? 1 : 0;
    last = nearest;
  }
  EXPECT_LE(steps_back, 3U) << "a piece of a cut triangle may lie nearer to another one's middle";
}

TEST_F(LooksOfAsset, AreThoseOfPatchesWhereTheSourceIsNotKnown) {
  Ball made = ball(6, 9);
  made.image.layout.material_classes.assign(static_cast<std::size_t>(made.image.size()), 0);
  made.image.layout.material_classes[3] = 5;
  made.image.layout.material_classes[4] = 3;
  const Asset asset = write(made, {.max_coarser_levels = 0}, false);
  ASSERT_EQ(asset.materials.size(), 3U);
  EXPECT_EQ(std::count(asset.levels[0].materials.begin(), asset.levels[0].materials.end(), 2), 2 * 8 * 8);
}

}  // namespace
}  // namespace lozenge
