#include "stages/compare/compare.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <numbers>

#include "formats/base/error.h"
#include "formats/domain/open_fixtures.h"
#include "formats/domain/sphere_fixtures.h"
#include "formats/surface/spread_points.h"

namespace lozenge {
namespace {

SourceMesh sphere(int n, float radius, Vec3f centre = {0, 0, 0}) {
  SourceMesh mesh = fixtures::subdivided_sphere(fixtures::icosahedron(), n).first;
  for (Vec3f& p : mesh.positions) p = p * radius + centre;
  return mesh;
}

SurfaceView view(const SourceMesh& mesh) { return {mesh.positions, mesh.triangles}; }

TEST(SurfacePoints, AreSpreadByArea) {
  // Triangles of areas 1, 2 and 5, one without area between them.
  const std::vector<Vec3f> positions{{0, 0, 0}, {2, 0, 0}, {0, 1, 0}, {0, 2, 0}, {0, 5, 0}};
  const std::vector<std::array<VertexId, 3>> triangles{{0, 1, 2}, {0, 1, 3}, {0, 0, 1}, {0, 1, 4}};
  const auto points = spread_points({positions, triangles}, 800);
  ASSERT_EQ(points.size(), 800U);
  std::array<int, 4> count{};
  for (const SurfacePoint& p : points) {
    ++count[p.triangle];
    EXPECT_GE(std::min({p.weights.x, p.weights.y, p.weights.z}), 0);
    EXPECT_NEAR(p.weights.x + p.weights.y + p.weights.z, 1, 1e-12);
  }
  EXPECT_EQ(count, (std::array<int, 4>{100, 200, 0, 500}));
}

TEST(SurfacePoints, HaveTheSurfacesCentreOfGravity) {
  const std::vector<Vec3f> positions{{0, 0, 0}, {3, 0, 0}, {0, 6, 0}};
  const std::vector<std::array<VertexId, 3>> triangles{{0, 1, 2}};
  const SurfaceView surface{positions, triangles};
  Vec3d sum(0, 0, 0);
  const auto points = spread_points(surface, 10'000);
  for (const SurfacePoint& p : points) sum += position_of(surface, p);
  const Vec3d mean = sum / static_cast<double>(points.size());
  EXPECT_NEAR(mean.x, 1, 1e-3);
  EXPECT_NEAR(mean.y, 2, 1e-3);
}

TEST(Compare, ASurfaceIsAtNoDistanceFromItself) {
  const SourceMesh mesh = sphere(8, 1);
  const Comparison c = compare(view(mesh), view(mesh), {5000});
  // Points are combinations of float corners in double; the query's own frame is rounded to float.
  EXPECT_LT(c.a_to_b.max, 1e-6);
  EXPECT_LT(c.b_to_a.max, 1e-6);
}

TEST(Compare, ConcentricSpheresAreAsFarApartAsTheirRadii) {
  for (const float radius : {1.02F, 1.5F}) {
    const SourceMesh a = sphere(24, 1);
    const SourceMesh b = sphere(24, radius);
    const Comparison c = compare(view(a), view(b), {4000});
    // The facets lie below the sphere by at most their sagitta, about (edge / 2)^2 of the radius: below 0.001 here.
    const double expected = radius - 1;
    EXPECT_NEAR(c.a_to_b.mean, expected, 1e-3 * radius);
    EXPECT_NEAR(c.b_to_a.mean, expected, 1e-3 * radius);
    EXPECT_NEAR(c.a_to_b.max, expected, 2e-3 * radius);
    EXPECT_NEAR(c.diagonal, 2 * std::sqrt(3.0), 0.01);
    EXPECT_NEAR(c.mean_percent(), 100 * expected / c.diagonal, 0.2);
  }
}

TEST(Compare, DistancesBothWaysDifferWhereOneSurfaceIsAPartOfTheOther) {
  const SourceMesh whole = sphere(20, 1);
  SourceMesh half = whole;
  std::erase_if(half.triangles, [&](const auto& t) {
    return whole.positions[t[0]].y < 0 || whole.positions[t[1]].y < 0 || whole.positions[t[2]].y < 0;
  });
  const Comparison c = compare(view(half), view(whole), {4000});
  EXPECT_LT(c.a_to_b.max, 1e-6);
  EXPECT_GT(c.b_to_a.mean, 0.2);  // the far hemisphere
  EXPECT_NEAR(c.b_to_a.max, std::sqrt(2.0), 0.1);
  EXPECT_EQ(c.mean_percent(), c.b_to_a.mean_percent);
}

TEST(Compare, TheLargestDistanceIsFoundAtAVertexBetweenThePoints) {
  const SourceMesh flat = sphere(10, 1);
  SourceMesh spiked = flat;
  spiked.positions[57] *= 4.0F;
  EXPECT_NEAR(compare(view(spiked), view(flat), {10}).a_to_b.max, 3, 0.02);
}

TEST(Compare, GivesTheSameBitsOnAnyNumberOfThreads) {
  const SourceMesh a = sphere(30, 1);
  const SourceMesh b = sphere(23, 1.01F, {0.01F, 0, 0});
  Comparison results[2];
  for (const int threads : {1, 2}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
    results[threads - 1] = compare(view(a), view(b), {6000});
  }
  EXPECT_EQ(std::memcmp(&results[0], &results[1], sizeof(Comparison)), 0);
}

TEST(Compare, RefusesSurfacesWithoutArea) {
  const SourceMesh a = sphere(2, 1);
  SourceMesh none;
  none.positions = {{0, 0, 0}, {1, 0, 0}};
  none.triangles = {{0, 1, 1}};
  using Pair = std::pair<const SourceMesh*, const SourceMesh*>;
  for (const auto& [x, y] : {Pair{&a, &none}, Pair{&none, &a}}) {
    try {
      compare(view(*x), view(*y));
      FAIL();
    } catch (const Error& e) {
      EXPECT_EQ(e.code(), ExitCode::kUnusableInput);
    }
  }
}

TEST(Compare, JsonHoldsTheNumbers) {
  const SourceMesh a = sphere(4, 1);
  const SourceMesh b = sphere(4, 2);
  const Comparison c = compare(view(a), view(b), {1000});
  const auto json = nlohmann::json::parse(comparison_json(c));
  EXPECT_EQ(json["a_to_b"]["mean"], c.a_to_b.mean);
  EXPECT_EQ(json["mean_percent"], c.mean_percent());
}

TEST(CompareBoundaries, OfASurfaceAndItselfAreTheSame) {
  for (const fixtures::OpenSurface& open : fixtures::open_surfaces()) {
    const Comparison c = compare(view(open.mesh), view(open.mesh), {500});
    EXPECT_EQ(c.boundary_loops_a, open.loops) << open.name;
    EXPECT_EQ(c.boundary_loops_b, open.loops) << open.name;
    EXPECT_LT(c.boundary_max_percent(), 1e-4) << open.name;
  }
}

TEST(CompareBoundaries, AreAsFarApartAsTheirFarthestPointsInEitherDirection) {
  // A square with a notch in one side; without it the surfaces are the same.
  SourceMesh square;
  square.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {1, 1.5F, 0}};
  square.triangles = {{0, 1, 5}, {1, 2, 5}, {2, 3, 5}, {3, 4, 5}, {4, 0, 5}};
  SourceMesh notched = square;
  notched.positions[1] = {1, 0.5F, 0};
  const Comparison c = compare(view(square), view(notched), {1000});
  EXPECT_NEAR(c.boundary_b_to_a, 0.5, 1e-6);                 // the notch's tip to the straight side
  EXPECT_NEAR(c.boundary_a_to_b, 1 / std::sqrt(5.0), 1e-3);  // the side's middle to the notch's flanks
  EXPECT_NEAR(c.boundary_max_percent(), 100 * 0.5 / std::sqrt(8.0), 1e-4);
}

TEST(CompareBoundaries, AreMeasuredBetweenVerticesToo) {
  // Both have the same vertices on the boundary but one, in the middle of a side.
  SourceMesh straight;
  straight.positions = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
  straight.triangles = {{0, 1, 2}};
  SourceMesh bent;
  bent.positions = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {2, -1, 0}};
  bent.triangles = {{0, 3, 2}, {3, 1, 2}};
  const Comparison c = compare(view(straight), view(bent), {1000});
  EXPECT_NEAR(c.boundary_b_to_a, 1, 1e-6);
  EXPECT_NEAR(c.boundary_a_to_b, 2 / std::sqrt(5.0), 1e-3);
}

TEST(CompareBoundaries, RunAlongBothSidesOfACutWhichLieOnEachOther) {
  // A strip around a cylinder, cut from rim to rim: as repair leaves a Moebius strip, the vertices of the cut are
  // there twice. The other surface is the same in finer triangles, which meet the cut in other places.
  const auto cut_band = [](int columns) {
    SourceMesh mesh;
    for (int i = 0; i <= columns; ++i) {
      const double u = 2 * std::numbers::pi * (i % columns) / columns;
      for (const double z : {0.0, 1.0}) mesh.positions.push_back(Vec3f(Vec3d(std::cos(u), std::sin(u), z)));
    }
    for (int i = 0; i < columns; ++i) {
      mesh.triangles.push_back({2 * i, 2 * i + 2, 2 * i + 1});
      mesh.triangles.push_back({2 * i + 2, 2 * i + 3, 2 * i + 1});
    }
    return mesh;
  };
  SourceMesh uncut = cut_band(96);
  const SourceMesh a = cut_band(48);
  SourceMesh b = cut_band(96);
  // Two sides that don't quite meet, as samples don't.
  for (const std::size_t v : {0U, 1U}) b.positions[v].y += 1e-6F;
  const Comparison both_cut = compare(view(a), view(b), {1000});
  EXPECT_EQ(both_cut.boundary_loops_a, 1);
  EXPECT_EQ(both_cut.boundary_loops_b, 1);
  EXPECT_LT(both_cut.boundary_max_percent(), 0.1);
  // Where one of them isn't cut, the middle of the other's cut is half a strip away from its rims.
  for (auto& corners : uncut.triangles) {
    for (VertexId& v : corners) v %= 2 * 96;
  }
  const Comparison one_cut = compare(view(a), view(uncut), {1000});
  EXPECT_EQ(one_cut.boundary_loops_b, 2);
  EXPECT_NEAR(one_cut.boundary_a_to_b, 0.5, 0.01);
}

TEST(CompareBoundaries, OfAClosedSurfaceAreNone) {
  const fixtures::OpenSurface open = fixtures::hemisphere(4);
  const SourceMesh closed = sphere(4, 1);
  const Comparison both_closed = compare(view(closed), view(closed), {100});
  EXPECT_EQ(comparison_lines(both_closed).size(), 3U);
  EXPECT_FALSE(nlohmann::json::parse(comparison_json(both_closed)).contains("boundary_max_distance_percent"));
  const auto one_closed = nlohmann::json::parse(comparison_json(compare(view(open.mesh), view(closed), {100})));
  EXPECT_TRUE(one_closed["boundary_max_distance_percent"].is_null());
  EXPECT_EQ(one_closed["boundary_loops"]["a"], 1);
  EXPECT_EQ(one_closed["boundary_loops"]["b"], 0);
}

/// One level with the sphere's own normals and no map.
Asset asset_of(const SourceMesh& mesh) {
  Asset asset;
  AssetLevel level;
  level.positions = mesh.positions;
  level.triangles = mesh.triangles;
  for (const Vec3f& p : mesh.positions) level.normals.push_back(p.normalized());
  asset.levels.push_back(level);
  return asset;
}

TEST(CompareNormals, AreEqualWhereBothSurfacesAreTheSame) {
  const SourceMesh mesh = sphere(12, 1);
  const NormalComparison n = compare_normals(asset_of(mesh), 0, mesh, {5000});
  EXPECT_LT(n.mean, 0.005);  // vertex normals of an icosphere are the radii up to the unevenness of its triangles
  EXPECT_EQ(n.points, 5000);
}

TEST(CompareNormals, FindAKnownTurn) {
  const SourceMesh mesh = sphere(12, 1);
  Asset asset = asset_of(mesh);
  const float turn = 0.2F;
  // Every normal leans towards a perpendicular direction by the same angle.
  for (Vec3f& n : asset.levels[0].normals) {
    const Vec3f side = n.cross(std::abs(n.y) < 0.9F ? Vec3f(0, 1, 0) : Vec3f(1, 0, 0)).normalized();
    n = n * std::cos(turn) + side * std::sin(turn);
  }
  const NormalComparison n = compare_normals(asset, 0, mesh, {5000});
  EXPECT_NEAR(n.mean, turn, 0.02);
}

TEST(CompareNormals, RefusesALevelThatIsNotThere) {
  const SourceMesh mesh = sphere(3, 1);
  EXPECT_THROW(compare_normals(asset_of(mesh), 1, mesh), Error);
}

}  // namespace
}  // namespace lozenge
