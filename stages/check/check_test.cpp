// Each guarantee is broken on purpose, and precisely its line must fail.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <random>
#include <set>

#include "formats/domain/sphere_fixtures.h"
#include "formats/files/asset_fixtures.h"
#include "formats/patches/image_fixtures.h"
#include "stages/check/check_asset.h"
#include "stages/check/check_geometry_image.h"
#include "stages/check/check_map.h"
#include "stages/check/check_parameterization.h"
#include "stages/check/check_patch_set.h"
#include "stages/check/check_source_mesh.h"

namespace lozenge {
namespace {

std::set<std::string> broken_lines(const CheckReport& report) {
  std::set<std::string> names;
  for (const CheckLine& line : report.lines) {
    if (!line.passed) names.insert(line.name);
  }
  return names;
}

using Names = std::set<std::string>;

/// All lines, for a failed test's message.
std::string text(const CheckReport& report) {
  std::string all;
  for (const std::string& line : report_lines(report)) all += line + "\n";
  return all;
}

TEST(CheckParameterization, PassesForSubdividedSpheresJitteredOrNot) {
  for (const Domain& base : {fixtures::tetrahedron(), fixtures::octahedron(), fixtures::icosahedron()}) {
    for (const int n : {1, 2, 3, 7, 12}) {
      auto [mesh, map] = fixtures::subdivided_sphere(base, n);
      EXPECT_TRUE(check_parameterization(mesh, map).passed()) << text(check_parameterization(mesh, map));
      fixtures::jitter(map, 0.3 / n, static_cast<unsigned>(n));
      const CheckReport report = check_parameterization(mesh, map);
      EXPECT_TRUE(report.passed()) << text(report);
      EXPECT_EQ(report.code, ExitCode::kDone);
    }
  }
}

/// A sphere over an icosahedron, 6 x 6 triangles in each domain triangle, and a vertex inside a domain triangle.
struct Sphere {
  SourceMesh mesh;
  Parameterization map;
  VertexId inner = -1;
  VertexId cone = -1;

  Sphere() {
    std::tie(mesh, map) = fixtures::subdivided_sphere(fixtures::icosahedron(), 6);
    for (std::size_t v = 0; v < map.phi.size(); ++v) {
      const DomainPoint& p = map.phi[v];
      if (vertex_at(map.domain, p) >= 0) cone = static_cast<VertexId>(v);
      if (p.alpha > 0.3 && p.beta > 0.3 && p.gamma() > 0.3) inner = static_cast<VertexId>(v);
    }
  }
};

TEST(CheckParameterization, FindsAFoldedTriangle) {
  Sphere s;
  DomainPoint& p = s.map.phi[s.inner];
  // Two cells away inside the same triangle: neighbours turn over, but the ring around stays where it was.
  p = make_point(p.triangle, p.alpha + 0.3, p.beta - 0.25);
  EXPECT_EQ(broken_lines(check_parameterization(s.mesh, s.map)), Names{"no folded triangle"});
}

TEST(CheckParameterization, FindsAConeWithoutAVertex) {
  Sphere s;
  DomainPoint& p = s.map.phi[s.cone];
  const double step = 0.02;  // an eighth of a cell
  p = make_point(p.triangle, p.alpha * (1 - 3 * step) + step, p.beta * (1 - 3 * step) + step);
  const Names broken = broken_lines(check_parameterization(s.mesh, s.map));
  EXPECT_TRUE(broken.count("a source vertex on every irregular domain vertex"))
      << text(check_parameterization(s.mesh, s.map));
}

TEST(CheckParameterization, FindsAMissingTriangleOfTheSource) {
  Sphere s;
  s.mesh.triangles.pop_back();
  EXPECT_EQ(broken_lines(check_parameterization(s.mesh, s.map)),
            (Names{"image areas add up to the domain's", "Euler characteristic of the source",
                   "the source's boundary runs along the domain's"}));
}

TEST(CheckParameterization, FindsATriangleThatNoInterpolationDomainHolds) {
  Sphere s;
  DomainPoint& p = s.map.phi[s.inner];
  // A domain triangle that shares no vertex with p's.
  for (DomainTriangleId t = 0; t < s.map.domain.size(); ++t) {
    bool apart = true;
    for (const DomainVertex v : s.map.domain.triangles[t].corners) {
      for (const DomainVertex w : s.map.domain.triangles[p.triangle].corners) apart = apart && v != w;
    }
    if (apart) {
      p.triangle = t;
      break;
    }
  }
  EXPECT_EQ(broken_lines(check_parameterization(s.mesh, s.map)), Names{"an image for every triangle"});
}

TEST(CheckParameterization, FindsPositionsOffTheLatticeOrTheDomain) {
  const double step = std::ldexp(1.0, -41);
  const DomainPoint bad[] = {{0, 0.25 + step, 0.25}, {0, -0.25, 0.25},
                             {0, 0.75, 0.5},         {99, 0.25, 0.25},
                             {-1, 0.25, 0.25},       {0, std::numeric_limits<double>::quiet_NaN(), 0}};
  for (const DomainPoint& p : bad) {
    Sphere s;
    s.map.phi[s.inner] = p;
    EXPECT_EQ(broken_lines(check_parameterization(s.mesh, s.map)), Names{"positions on the domain's lattice"});
  }
}

TEST(CheckParameterization, FindsAMissingPosition) {
  Sphere s;
  s.map.phi.pop_back();
  EXPECT_EQ(broken_lines(check_parameterization(s.mesh, s.map)), Names{"a position for every vertex"});
}

TEST(CheckParameterization, FindsATriangleOfAVertexThatIsNotThere) {
  Sphere s;
  s.mesh.triangles[5][1] = static_cast<VertexId>(s.mesh.positions.size());
  EXPECT_EQ(broken_lines(check_parameterization(s.mesh, s.map)), Names{"triangles name existing vertices"});
}

TEST(CheckParameterization, FindsADomainWhoseNeighboursDisagree) {
  Sphere s;
  s.map.domain.triangles[3].neighbours[1] = {7, 2};
  EXPECT_EQ(broken_lines(check_parameterization(s.mesh, s.map)), Names{"sound domain"});
}

TEST(CheckParameterization, FindsTwoSheetsOnOneComponentAndNoneOnTheOther) {
  // Two spheres of the source over one of two octahedra: every sum but that of each component is right.
  auto [mesh, map] = fixtures::subdivided_sphere(fixtures::octahedron(), 4);
  const auto count = static_cast<VertexId>(mesh.positions.size());
  const auto triangles = mesh.triangles;
  for (const auto& [a, b, c] : triangles) mesh.triangles.push_back({a + count, b + count, c + count});
  for (VertexId v = 0; v < count; ++v) {
    mesh.positions.push_back(mesh.positions[v] + Vec3f(3, 0, 0));
    map.phi.push_back(map.phi[v]);
  }
  const auto one = map.domain;
  for (DomainTriangle t : one.triangles) {
    for (DomainVertex& v : t.corners) v += one.vertex_count;
    for (DomainSide& n : t.neighbours) n.triangle += one.size();
    map.domain.triangles.push_back(t);
  }
  map.domain.vertex_count *= 2;
  EXPECT_EQ(broken_lines(check_parameterization(mesh, map)),
            (Names{"image areas add up to the domain's", "a source vertex on every irregular domain vertex"}));
}

TEST(CheckParameterization, FindsAnEdgeOfTwoLengths) {
  // A vertex thrown to the other side of a cone: the triangles on both sides of an edge of its unfold on different ways
  // around the cone.
  std::mt19937 random(1);
  int found = 0;
  for (int trial = 0; trial < 300; ++trial) {
    auto [mesh, map] = fixtures::subdivided_sphere(fixtures::tetrahedron(), 3);
    const auto v = static_cast<std::size_t>(random() % map.phi.size());
    const auto t = static_cast<DomainTriangleId>(random() % map.domain.size());
    const double alpha = 0.1 + 0.1 * static_cast<double>(random() % 5);
    map.phi[v] = make_point(t, alpha, (1 - alpha) * 0.5);
    const CheckReport report = check_parameterization(mesh, map);
    const CheckLine* line = report.find("edges have one length from both sides");
    if (!line || line->passed) continue;
    ++found;
    EXPECT_NE(line->detail.find("edge"), std::string::npos);
    EXPECT_NE(line->detail.find(" long in triangle "), std::string::npos);
  }
  EXPECT_GT(found, 0);
}

class CheckGeometryImage : public testing::Test {
 protected:
  GeometryImage image_ = fixtures::sphere_image(fixtures::icosahedron(), 3);
  Vec3f& position(std::size_t level, std::int32_t p, std::int32_t i, std::int32_t j) {
    return image_.levels[level].positions[image_.index(image_.levels[level], p, i, j)];
  }
  Vec3f& normal(std::size_t level, std::int32_t p, std::int32_t i, std::int32_t j) {
    return image_.levels[level].normals[image_.index(image_.levels[level], p, i, j)];
  }
};

TEST_F(CheckGeometryImage, PassesForSpheresOverEveryPlatonicDomain) {
  for (const Domain& base : {fixtures::tetrahedron(), fixtures::octahedron(), fixtures::icosahedron()}) {
    for (const int k : {0, 1, 2, 4}) {
      const CheckReport report = check_geometry_image(fixtures::sphere_image(base, k));
      EXPECT_TRUE(report.passed()) << text(report);
    }
  }
}

TEST_F(CheckGeometryImage, FindsOneBitAtABorder) {
  // Odd places on a border are on the finest level alone.
  Vec3f& p = position(0, 4, 3, 0);
  p.x = std::nextafter(p.x, 0.0F);
  EXPECT_EQ(broken_lines(check_geometry_image(image_)),
            (Names{"borders hold the same bits on both sides",
                   "every level is closed, oriented, 2-manifold when welded by bits"}));
}

TEST_F(CheckGeometryImage, FindsOneBitOfANormalAtABorder) {
  Vec3f& n = normal(0, 4, 3, 0);
  n.x = std::nextafter(n.x, 0.0F);
  EXPECT_EQ(broken_lines(check_geometry_image(image_)), Names{"borders hold the same bits on both sides"});
}

TEST_F(CheckGeometryImage, FindsACoarserLevelThatIsNoSubsample) {
  Vec3f& p = position(1, 2, 1, 2);
  p.y = std::nextafter(p.y, 0.0F);
  EXPECT_EQ(broken_lines(check_geometry_image(image_)), Names{"coarser levels are every second sample"});
}

TEST_F(CheckGeometryImage, FindsASampleThatIsNotFinite) {
  position(0, 0, 1, 1).z = std::numeric_limits<float>::infinity();
  EXPECT_TRUE(broken_lines(check_geometry_image(image_)).count("positions are finite"));
}

TEST_F(CheckGeometryImage, FindsASampleOutsideTheBounds) {
  position(0, 0, 1, 1) *= 1.5F;
  EXPECT_EQ(broken_lines(check_geometry_image(image_)), Names{"positions lie inside the source's bounds"});
}

TEST_F(CheckGeometryImage, FindsANormalThatIsNotUnit) {
  normal(0, 7, 5, 1) *= 1.001F;
  EXPECT_EQ(broken_lines(check_geometry_image(image_)), Names{"normals are unit vectors"});
}

TEST_F(CheckGeometryImage, FindsAdjacencyThatIsNotReciprocal) {
  image_.layout.adjacency[3][2].side = (image_.layout.adjacency[3][2].side + 1) % 4;
  EXPECT_EQ(broken_lines(check_geometry_image(image_)), Names{"adjacency is reciprocal"});
}

TEST_F(CheckGeometryImage, FindsReciprocalAdjacencyOfTheWrongPatches) {
  // Two pairs of sides swap partners; all remains reciprocal.
  const PatchSide a{0, 0};
  const PatchSide b{9, 1};
  const PatchSide a2 = image_.layout.adjacency[a.patch][a.side];
  const PatchSide b2 = image_.layout.adjacency[b.patch][b.side];
  const auto join = [&](PatchSide x, PatchSide y) {
    image_.layout.adjacency[x.patch][x.side] = y;
    image_.layout.adjacency[y.patch][y.side] = x;
  };
  join(a, b2);
  join(b, a2);
  EXPECT_EQ(broken_lines(check_geometry_image(image_)), Names{"adjacency follows the domain"});
}

TEST_F(CheckGeometryImage, FindsTwoPlacesOfTheSurfaceThatCoincide) {
  // Two inner samples of different patches are welded: the surface touches itself there.
  position(0, 0, 3, 3) = position(0, 11, 3, 3);
  const Names broken = broken_lines(check_geometry_image(image_));
  EXPECT_EQ(broken, Names{"every level is closed, oriented, 2-manifold when welded by bits"});
}

TEST_F(CheckGeometryImage, FindsALevelOfTheWrongSize) {
  image_.levels[1].samples = 4;
  EXPECT_EQ(broken_lines(check_geometry_image(image_)), Names{"layout of tiles and levels"});
  image_ = fixtures::sphere_image(fixtures::octahedron(), 2);
  image_.levels[0].positions.pop_back();
  EXPECT_EQ(broken_lines(check_geometry_image(image_)), Names{"layout of tiles and levels"});
  image_ = fixtures::sphere_image(fixtures::octahedron(), 2);
  image_.levels.pop_back();
  EXPECT_EQ(broken_lines(check_geometry_image(image_)), Names{"layout of tiles and levels"});
}

class CheckPatchSet : public testing::Test {
 protected:
  PatchSet patches_ = fixtures::sphere_patches(fixtures::octahedron(), 3);
};

TEST_F(CheckPatchSet, PassesForASphere) {
  const CheckReport report = check_patch_set(patches_);
  EXPECT_TRUE(report.passed()) << text(report);
}

TEST_F(CheckPatchSet, FindsOneBitAtABorder) {
  Vec3f& p = patches_.positions[patches_.index(5, 0, 3)];
  p.y = std::nextafter(p.y, 2.0F);
  EXPECT_EQ(broken_lines(check_patch_set(patches_)), Names{"borders hold the same bits on both sides"});
}

TEST_F(CheckPatchSet, FindsASampleWithoutASourceTriangle) {
  patches_.source_triangles[10] = -1;
  EXPECT_EQ(broken_lines(check_patch_set(patches_)), Names{"every sample lies in a source triangle"});
  patches_ = fixtures::sphere_patches(fixtures::octahedron(), 3);
  patches_.source_weights[10] = {0.5F, 0.6F, -0.1F};
  EXPECT_EQ(broken_lines(check_patch_set(patches_)), Names{"every sample lies in a source triangle"});
}

TEST_F(CheckPatchSet, FindsGridsThatAreNotOfPowersOfTwo) {
  patches_.layout.samples = 8;
  EXPECT_EQ(broken_lines(check_patch_set(patches_)), Names{"grids of 2^k + 1 samples a side"});
}

class CheckAsset : public testing::Test {
 protected:
  Asset asset_ = fixtures::sphere_asset();
};

TEST_F(CheckAsset, PassesForASphere) {
  const CheckReport report = check_asset(asset_);
  EXPECT_TRUE(report.passed()) << text(report);
}

TEST_F(CheckAsset, FindsAHole) {
  // One vertex of a triangle moves alone, with its own copy, so that the weld there breaks.
  AssetLevel& level = asset_.levels[0];
  const VertexId v = level.triangles[0][0];
  level.positions.push_back(level.positions[v] * 1.01F);
  level.normals.push_back(level.normals[v]);
  level.tangents.push_back(level.tangents[v]);
  level.uvs.push_back(level.uvs[v]);
  level.triangles[0][0] = static_cast<VertexId>(level.positions.size()) - 1;
  EXPECT_TRUE(broken_lines(check_asset(asset_)).count("every level is watertight when welded by bits"));
}

TEST_F(CheckAsset, WeldsSplitVertices) {
  AssetLevel& level = asset_.levels[0];
  const VertexId v = level.triangles[0][0];
  level.positions.push_back(level.positions[v]);
  level.normals.push_back(level.normals[v]);
  level.tangents.push_back(level.tangents[v]);
  level.uvs.push_back(level.uvs[v]);
  level.triangles[0][0] = static_cast<VertexId>(level.positions.size()) - 1;
  EXPECT_TRUE(check_asset(asset_).passed()) << text(check_asset(asset_));
}

TEST_F(CheckAsset, FindsALevelOfAnotherTopology) {
  AssetLevel& level = asset_.levels[1];
  const auto n = static_cast<VertexId>(level.positions.size());
  const auto triangles = level.triangles;
  for (const auto& [a, b, c] : triangles) level.triangles.push_back({a + n, b + n, c + n});
  for (VertexId v = 0; v < n; ++v) {
    level.positions.push_back(level.positions[v] + Vec3f(5, 0, 0));
    level.normals.push_back(level.normals[v]);
    level.tangents.push_back(level.tangents[v]);
    level.uvs.push_back(level.uvs[v]);
  }
  EXPECT_EQ(broken_lines(check_asset(asset_)), Names{"every level has the same Euler characteristic"});
}

TEST_F(CheckAsset, FindsEachBrokenAttribute) {
  const auto broken_after = [](auto change) {
    Asset asset = fixtures::sphere_asset();
    change(asset.levels[0]);
    return broken_lines(check_asset(asset));
  };
  EXPECT_EQ(broken_after([](AssetLevel& l) { l.normals[3] *= 1.01F; }), Names{"normals are unit vectors"});
  EXPECT_EQ(broken_after([](AssetLevel& l) { l.tangents[3].w = 0; }), Names{"tangents are unit vectors with a sign"});
  EXPECT_EQ(broken_after([](AssetLevel& l) {
              const Vec3f n = l.normals[3];
              l.tangents[3] = Vec4f(n.x, n.y, n.z, 1);
            }),
            Names{"tangents are perpendicular to normals"});
  EXPECT_EQ(broken_after([](AssetLevel& l) { l.uvs[3].x = 1.01F; }), Names{"texture coordinates lie in 0..1"});
  EXPECT_EQ(broken_after([](AssetLevel& l) { l.uvs.pop_back(); }),
            Names{"normals, tangents and texture coordinates at every vertex"});
  EXPECT_EQ(broken_after([](AssetLevel& l) { l.triangles[2][1] = 1'000'000; }),
            Names{"triangles name existing vertices, all of them"});
  EXPECT_EQ(broken_after([](AssetLevel& l) {
              l.material = 4;
            }).count("materials are drawn, and their textures can be decoded"),
            1U);
}

TEST_F(CheckAsset, FindsATriangleOfAFittedLevelThatIsTurned) {
  asset_.is_fitted = true;
  AssetLevel& level = asset_.levels[0];
  // Upright in the atlas: each triangle by itself.
  AssetLevel apart;
  for (const auto& t : level.triangles) {
    const auto first = static_cast<VertexId>(apart.positions.size());
    for (std::size_t k = 0; k < 3; ++k) {
      apart.positions.push_back(level.positions[t[k]]);
      apart.normals.push_back(level.normals[t[k]]);
      apart.tangents.push_back(level.tangents[t[k]]);
      apart.uvs.push_back(k == 0 ? Vec2f(0.1F, 0.1F) : k == 1 ? Vec2f(0.9F, 0.1F) : Vec2f(0.1F, 0.9F));
    }
    apart.triangles.push_back({first, first + 1, first + 2});
  }
  apart.material = level.material;
  AssetPart& part = apart.parts.emplace_back();
  part.vertices = apart.positions.size();
  part.triangles = apart.triangles.size();
  part.places = {kUnmoved};
  asset_.levels = {apart, apart};
  EXPECT_TRUE(check_asset(asset_).passed()) << text(check_asset(asset_));
  std::swap(asset_.levels[1].uvs[0], asset_.levels[1].uvs[1]);
  EXPECT_EQ(broken_lines(check_asset(asset_)), Names{"no triangle is folded in the atlas"});
  asset_.levels[1] = apart;
  // A corner is pulled to beyond the far side of its triangle, in all copies that it has.
  const Vec3f pulled = apart.positions[0];
  const Vec3f far = apart.positions[1] + apart.positions[2] - pulled;
  for (Vec3f& p : asset_.levels[1].positions) {
    if (p == pulled) p = far;
  }
  EXPECT_EQ(broken_lines(check_asset(asset_)), Names{"no triangle is turned against its neighbours"});
}

TEST_F(CheckAsset, FindsANormalMapThatIsNotOfUnitVectors) {
  asset_.textures[0].pixels[30] = 0.2F;
  EXPECT_EQ(broken_lines(check_asset(asset_)), Names{"normal maps hold unit vectors"});
}

TEST(CheckMap, AcceptsQuantizedUnitNormalsAndRefusesOthers) {
  BakedMap map = fixtures::flat_normal_map();
  for (const int bits : {8, 16}) {
    // What a file of so many bits gives back of (0.6, 0, 0.8).
    const double steps = std::pow(2.0, bits) - 1;
    const auto stored = [&](double x) { return static_cast<float>(std::round((x + 1) / 2 * steps) / steps * 2 - 1); };
    for (std::size_t i = 0; i < map.texels.size(); i += 3) {
      map.texels[i] = stored(0.6);
      map.texels[i + 1] = stored(0);
      map.texels[i + 2] = stored(0.8);
    }
    EXPECT_TRUE(check_map(map, bits).passed()) << text(check_map(map, bits));
  }
  map.texels[3 * 17] = 0.9F;
  EXPECT_EQ(broken_lines(check_map(map, 16)), Names{"normals are unit vectors"});
}

TEST(CheckMap, FindsALayoutThatDoesNotFit) {
  BakedMap map = fixtures::flat_normal_map();
  map.layout.columns = 100;
  EXPECT_EQ(broken_lines(check_map(map, 16)), Names{"layout of tiles"});
  map = fixtures::flat_normal_map();
  map.texels.pop_back();
  EXPECT_EQ(broken_lines(check_map(map, 16)), Names{"layout of tiles"});
}

TEST(CheckMap, FindsOcclusionOutsideItsRange) {
  BakedMap map = fixtures::flat_normal_map();
  map.kind = MapKind::kOcclusion;
  map.channels = 1;
  map.texels.assign(static_cast<std::size_t>(map.layout.width) * map.layout.height, 0.5F);
  EXPECT_TRUE(check_map(map, 8).passed()) << text(check_map(map, 8));
  map.texels[40] = 1.5F;
  EXPECT_EQ(broken_lines(check_map(map, 8)), Names{"values in range"});
}

TEST(CheckReport, CarriesAnExitCodeAndJson) {
  CheckReport report;
  report.kind = "asset";
  EXPECT_FALSE(report.passed());  // nothing was proved
  report.add("first", true, "");
  EXPECT_TRUE(report.passed());
  report.add("second", false, "here");
  EXPECT_FALSE(report.passed());
  EXPECT_EQ(report.code, ExitCode::kUnusableInput);
  const auto json = nlohmann::json::parse(report_json(report));
  EXPECT_EQ(json["checks"][1]["detail"], "here");
  EXPECT_EQ(json["passed"], false);
}

}  // namespace
}  // namespace lozenge
