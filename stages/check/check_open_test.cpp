// Surfaces with a boundary: their guarantees hold, and each one broken on purpose is found.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "formats/domain/open_fixtures.h"
#include "formats/domain/sphere_fixtures.h"
#include "formats/patches/image_fixtures.h"
#include "formats/patches/level_mesh.h"
#include "formats/surface/boundary.h"
#include "stages/check/check_asset.h"
#include "stages/check/check_geometry_image.h"
#include "stages/check/check_map.h"
#include "stages/check/check_parameterization.h"
#include "stages/check/check_patch_set.h"
#include "stages/check/check_source_mesh.h"

namespace lozenge {
namespace {

using Names = std::set<std::string>;

Names broken_lines(const CheckReport& report) {
  Names names;
  for (const CheckLine& line : report.lines) {
    if (!line.passed) names.insert(line.name);
  }
  return names;
}

std::string text(const CheckReport& report) {
  std::string all;
  for (const std::string& line : report_lines(report)) all += line + "\n";
  return all;
}

constexpr const char* kRunsAlong = "the source's boundary runs along the domain's";

TEST(CheckOpenParameterization, PassesWhateverTheBoundaryIs) {
  for (const fixtures::OpenSurface& open : fixtures::open_surfaces()) {
    const CheckReport report = check_parameterization(open.mesh, open.map);
    EXPECT_TRUE(report.passed()) << open.name << "\n" << text(report);
    ASSERT_NE(report.find(kRunsAlong), nullptr);
    const std::string loops = std::to_string(open.loops) + " loop";
    EXPECT_NE(report.find(kRunsAlong)->detail.find(loops), std::string::npos) << text(report);
  }
}

TEST(CheckOpenParameterization, FindsABoundaryVertexThatLeftTheBoundary) {
  fixtures::OpenSurface open = fixtures::triangle(4);
  for (DomainPoint& p : open.map.phi) {
    if (p.gamma() != 0 || corner_at(p) >= 0) continue;
    p = make_point(p.triangle, p.alpha - 0.03, p.beta);
    break;
  }
  EXPECT_EQ(broken_lines(check_parameterization(open.mesh, open.map)),
            (Names{kRunsAlong, "image areas add up to the domain's"}));
}

TEST(CheckOpenParameterization, FindsABoundaryThatIsSlidAlongASideOfTheDomainInside) {
  // The source is one triangle smaller, its domain isn't: it ends on a side with a neighbour.
  fixtures::OpenSurface open = fixtures::fan(2, 1);
  open.mesh.triangles.pop_back();
  const Names broken = broken_lines(check_parameterization(open.mesh, open.map));
  EXPECT_TRUE(broken.contains(kRunsAlong));
}

TEST(CheckOpenParameterization, FindsASourceEdgeThatCutsAcrossABentBoundary) {
  // A triangle's corner without a source vertex: the source has an edge from side to side there.
  fixtures::OpenSurface open = fixtures::triangle(2);
  std::erase_if(open.mesh.triangles, [&](const auto& t) {
    return std::any_of(t.begin(), t.end(), [&](VertexId v) { return corner_at(open.map.phi[v]) == 0; });
  });
  EXPECT_TRUE(broken_lines(check_parameterization(open.mesh, open.map)).contains(kRunsAlong));
}

TEST(CheckOpenParameterization, FindsABoundaryVertexOfTwoTrianglesWithoutASourceVertex) {
  fixtures::OpenSurface open = fixtures::hemisphere(4);
  for (DomainPoint& p : open.map.phi) {
    const DomainVertex v = vertex_at(open.map.domain, p);
    if (v < 0 || valences(open.map.domain)[v] != 2) continue;
    // Along the boundary side that leaves it.
    const DomainCorner corner = corner_of_each_vertex(open.map.domain)[v];
    std::array<double, 3> weights{};
    weights[corner.corner] = 0.9375;
    weights[(corner.corner + 1) % 3] = 0.0625;
    p = make_point(corner.triangle, weights[0], weights[1]);
    break;
  }
  const Names broken = broken_lines(check_parameterization(open.mesh, open.map));
  EXPECT_TRUE(broken.contains("a source vertex on every irregular domain vertex"));
  EXPECT_TRUE(broken.contains(kRunsAlong));
}

class CheckOpenImage : public testing::Test {
 protected:
  GeometryImage image_ = fixtures::open_image(fixtures::annulus(5, 17, 4, 0.375), 3);
  std::int32_t half_ = first_half(image_.layout.places);

  static std::int32_t first_half(const std::vector<PatchPlace>& places) {
    std::int32_t p = 0;
    while (places[p].right.exists()) ++p;
    return p;
  }
};

TEST_F(CheckOpenImage, PassesWhateverTheBoundaryIs) {
  for (const fixtures::OpenSurface& open : fixtures::open_surfaces()) {
    for (const int k : {0, 1, 3}) {
      const CheckReport report = check_geometry_image(fixtures::open_image(open, k));
      EXPECT_TRUE(report.passed()) << open.name << ", " << k << "\n" << text(report);
      const CheckReport patches = check_patch_set(fixtures::open_patches(open, k));
      EXPECT_TRUE(patches.passed()) << open.name << ", " << k << "\n" << text(patches);
    }
  }
}

TEST_F(CheckOpenImage, FindsASampleBeyondTheBoundary) {
  GeometryLevel& level = image_.levels[0];
  level.positions[image_.index(level, half_, 5, 3)].x = 0.25F;
  EXPECT_EQ(broken_lines(check_geometry_image(image_)), Names{"nothing is sampled beyond the boundary"});
}

TEST_F(CheckOpenImage, FindsAHoleThatIsNoDiagonal) {
  // Two patches lose their common border at one sample of the finest level.
  std::int32_t p = 0;
  while (!image_.layout.places[p].right.exists()) ++p;
  GeometryLevel& level = image_.levels[0];
  Vec3f& sample = level.positions[image_.index(level, p, 0, 3)];
  sample.x = std::nextafter(sample.x, 9.0F);
  const Names broken = broken_lines(check_geometry_image(image_));
  EXPECT_TRUE(broken.contains("borders hold the same bits on both sides"));
  EXPECT_TRUE(broken.contains("every level ends on the diagonals of half patches, and nowhere else"));
}

TEST_F(CheckOpenImage, FindsAPatchThatLostItsRightHalf) {
  // A patch inside says that the surface ends there; its neighbours don't.
  std::int32_t p = 0;
  while (!image_.layout.places[p].right.exists()) ++p;
  image_.layout.places[p].right = {};
  EXPECT_TRUE(broken_lines(check_geometry_image(image_)).contains("adjacency follows the domain"));
}

TEST_F(CheckOpenImage, FindsANeighbourAcrossTheMissingHalf) {
  std::int32_t other = half_ + 1;
  while (image_.layout.places[other].right.exists()) ++other;
  image_.layout.adjacency[half_][0] = {other, 0};
  image_.layout.adjacency[other][0] = {half_, 0};
  EXPECT_EQ(broken_lines(check_geometry_image(image_)), Names{"adjacency follows the domain"});
}

TEST_F(CheckOpenImage, FindsASampleOfAPatchSetBeyondTheBoundary) {
  PatchSet patches = fixtures::open_patches(fixtures::hemisphere(3), 2);
  const std::int32_t p = first_half(patches.layout.places);
  patches.source_triangles[patches.index(p, 4, 0)] = 3;
  EXPECT_EQ(broken_lines(check_patch_set(patches)), Names{"nothing is sampled beyond the boundary"});
}

/// Levels as welded meshes, with attributes that a checker accepts.
Asset asset_of(const GeometryImage& image) {
  Asset asset;
  asset.samples = image.layout.samples;
  for (const PatchPlace& place : image.layout.places) asset.half_patches += !place.right.exists();
  for (std::size_t l = 0; l < image.levels.size(); ++l) {
    const LevelMesh mesh = level_mesh(image, static_cast<int>(l));
    AssetLevel level;
    level.positions = mesh.positions;
    level.triangles = mesh.triangles;
    level.normals.assign(mesh.positions.size(), Vec3f(0, 0, 1));
    level.tangents.assign(mesh.positions.size(), Vec4f(1, 0, 0, 1));
    level.uvs.assign(mesh.positions.size(), Vec2f(0.5F, 0.5F));
    asset.levels.push_back(std::move(level));
  }
  return asset;
}

TEST(CheckOpenAsset, PassesWhateverTheBoundaryIs) {
  for (const fixtures::OpenSurface& open : fixtures::open_surfaces()) {
    const CheckReport report = check_asset(asset_of(fixtures::open_image(open, 3)));
    EXPECT_TRUE(report.passed()) << open.name << "\n" << text(report);
  }
}

TEST(CheckOpenAsset, PassesWithoutCapsWhereItSaysSoAndStillFindsTurnedTriangles) {
  Asset asset = asset_of(fixtures::sphere_image(fixtures::octahedron(), 4));
  for (AssetLevel& level : asset.levels) {
    level.triangles.erase(level.triangles.begin() + 10);
    ++asset.cap_triangles;
  }
  EXPECT_TRUE(check_asset(asset).passed()) << text(check_asset(asset));
  std::swap(asset.levels[0].triangles[5][0], asset.levels[0].triangles[5][1]);
  EXPECT_EQ(broken_lines(check_asset(asset)), Names{"every level is oriented when welded by bits"});
}

TEST_F(CheckOpenImage, FindsMarksOfCapsWhereNothingIs) {
  for (GeometryLevel& level : image_.levels) level.caps.assign(level.positions.size(), 0);
  EXPECT_TRUE(check_geometry_image(image_).passed());
  image_.levels.front().caps[image_.index(image_.levels.front(), half_, 4, 0)] = 1;
  EXPECT_EQ(broken_lines(check_geometry_image(image_)), Names{"samples on caps are marked"});
}

TEST(CheckOpenAsset, FindsALostTriangle) {
  Asset asset = asset_of(fixtures::open_image(fixtures::hemisphere(4), 3));
  asset.levels[1].triangles.erase(asset.levels[1].triangles.begin() + 40);
  EXPECT_TRUE(broken_lines(check_asset(asset))
                  .contains("every level is watertight but for its source's boundary when welded by bits"));
}

TEST(CheckOpenAsset, FindsABoundaryThatNobodySpokeOf) {
  Asset asset = asset_of(fixtures::open_image(fixtures::hemisphere(4), 3));
  asset.half_patches = 0;
  EXPECT_EQ(broken_lines(check_asset(asset)), Names{"every level is watertight when welded by bits"});
}

TEST(CheckOpenAsset, FindsALevelThatEndsElsewhere) {
  Asset asset = asset_of(fixtures::open_image(fixtures::annulus(5, 17, 4, 0.375), 3));
  const BoundarySide side = boundary_sides(asset.levels[2].view()).front();
  asset.levels[2].positions[side[0]].z += 0.125F;
  EXPECT_EQ(broken_lines(check_asset(asset)), Names{"every level ends where the finest does"});
}

}  // namespace
}  // namespace lozenge
