#include "stages/parameterize/map/path_lengths.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numeric>
#include <random>
#include <utility>
#include <vector>

#include "formats/domain/sphere_fixtures.h"
#include "stages/parameterize/operations/flip.h"
#include "stages/parameterize/surface_fixtures.h"

namespace lozenge {
namespace {

constexpr double kPi = 3.14159265358979323846;
// Angles between neighbouring corners, seen from the centre: also the lengths of the arcs between them on the unit
// sphere.
const double kOctahedronArc = kPi / 2;
const double kIcosahedronArc = std::atan(2.0);

/// A sphere of unit radius, with its map and measures that don't look at any embedding.
struct MeasuredSphere {
  MeasuredSphere(const Domain& base, int n) {
    auto [surface, exact] = fixtures::subdivided_sphere(base, n);
    mesh = std::move(surface);
    map = working_map(mesh, exact);
    measures.vertex_area = voronoi_areas(map);
    measures.warming_up = false;
  }
  MeasuredSphere(const MeasuredSphere&) = delete;  // the map points to the mesh
  MeasuredSphere& operator=(const MeasuredSphere&) = delete;

  SourceMesh mesh;
  WorkingMap map;
  SurfaceMeasures measures;
};

/// A map that has nothing but a mesh: all that Voronoi areas need.
WorkingMap bare_map(const std::vector<Vec3f>& positions, const std::vector<std::array<VertexId, 3>>& triangles) {
  WorkingMap map;
  map.positions = &positions;
  map.mesh = make_halfedge_mesh(triangles, static_cast<std::int32_t>(positions.size()));
  return map;
}

double area_of(const std::vector<Vec3f>& positions, const std::vector<std::array<VertexId, 3>>& triangles) {
  double sum = 0;
  for (const auto& [a, b, c] : triangles) {
    const Vec3d p(positions[a]);
    sum += (Vec3d(positions[b]) - p).cross(Vec3d(positions[c]) - p).length() / 2;
  }
  return sum;
}

double sum_of(const std::vector<float>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

TEST(VoronoiAreas, SumToTheSurfacesArea) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const SourceMesh mesh = test::sphere(3 + static_cast<int>(seed % 9), test::random_relief(0.3, seed));
    const double area = area_of(mesh.positions, mesh.triangles);
    EXPECT_NEAR(sum_of(voronoi_areas(bare_map(mesh.positions, mesh.triangles))), area, 1e-6 * area);
  }
}

TEST(VoronoiAreas, SumToTheAreaOfAnyTriangleHoweverObtuse) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> coordinate(-1, 1), decades(-6, 0);
  for (int i = 0; i < 5000; ++i) {
    std::vector<Vec3f> positions;
    for (int c = 0; c < 3; ++c) positions.emplace_back(coordinate(random), coordinate(random), coordinate(random));
    if (i % 2 == 0) {
      // The third corner beside the first side or its continuation, down to a millionth of it away.
      const float along = 2 * coordinate(random);
      const float away = std::pow(10.0F, decades(random));
      positions[2] = positions[0] * (1 - along) + positions[1] * along + positions[2] * away;
    }
    const double area = area_of(positions, {{0, 1, 2}});
    const auto areas = voronoi_areas(bare_map(positions, {{0, 1, 2}}));
    EXPECT_NEAR(sum_of(areas), area, 1e-6 * area);
    for (const float a : areas) EXPECT_GE(a, -1e-6 * area);
  }
}

TEST(VoronoiAreas, AreThatOfThePointsNearestToTheVertexWhereTheTriangleIsNotObtuse) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int i = 0; i < 20; ++i) {
    // About a circumcentre that lies inside.
    std::vector<Vec3f> positions;
    for (int c = 0; c < 3; ++c) {
      const double angle = 2 * kPi * c / 3 + 0.4 * unit(random);
      positions.emplace_back(static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle)), 0.5F);
    }
    const auto areas = voronoi_areas(bare_map(positions, {{0, 1, 2}}));
    // By a fine grid of cells.
    constexpr int kGrid = 200;
    std::array<int, 3> nearest{};
    int cells = 0;
    for (int a = 0; a < kGrid; ++a) {
      for (int b = 0; a + b < kGrid; ++b) {
        for (const double third : {1.0 / 3, 2.0 / 3}) {
          if (third > 0.5 && a + b + 1 >= kGrid) continue;
          const auto u = static_cast<float>((a + third) / kGrid), v = static_cast<float>((b + third) / kGrid);
          const Vec3f p = positions[0] * (1 - u - v) + positions[1] * u + positions[2] * v;
          int best = 0;
          for (int c = 1; c < 3; ++c) {
            if ((positions[c] - p).length2() < (positions[best] - p).length2()) best = c;
          }
          ++nearest[best];
          ++cells;
        }
      }
    }
    const double area = area_of(positions, {{0, 1, 2}});
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(areas[c], area * nearest[c] / cells, 0.01 * area);
  }
}

TEST(VoronoiAreas, LeaveRemovedTrianglesAndUnusedVerticesOut) {
  const SourceMesh mesh = test::sphere(4, test::random_relief(0.2, 1));
  WorkingMap map = bare_map(mesh.positions, mesh.triangles);
  auto left = mesh.triangles;
  for (const TriangleId t : {0, 17, 63}) map.mesh.triangles[t] = {-1, -1, -1};
  for (const TriangleId t : {63, 17, 0}) left.erase(left.begin() + t);
  EXPECT_NEAR(sum_of(voronoi_areas(map)), area_of(mesh.positions, left), 1e-5);
}

TEST(RegionAreas, SumToTheSpheresArea) {
  for (const Domain& base : {fixtures::tetrahedron(), fixtures::octahedron(), fixtures::icosahedron()}) {
    for (const int n : {8, 16, 40}) {
      const MeasuredSphere sphere(base, n);
      double sum = 0;
      for (DomainTriangleId t = 0; t < base.size(); ++t) sum += region_area(sphere.map, sphere.measures, t);
      const double area = area_of(sphere.mesh.positions, sphere.mesh.triangles);
      EXPECT_NEAR(sum, area, 1e-5 * area);
      // The mesh is inscribed; its edges are up to 2 / n long on the tetrahedron, so it is 1 / n^2 or so short.
      EXPECT_LT(sum, 4 * kPi);
      EXPECT_GT(sum, 4 * kPi * (1 - 4.0 / (n * n)));
    }
  }
}

TEST(RegionAreas, ApproachEqualSharesOfTheRegularDomains) {
  // Vertices on a side are at home in one of its two triangles, so a share is wrong by the rows along its sides at
  // most.
  for (const Domain& base : {fixtures::octahedron(), fixtures::icosahedron()}) {
    for (const int n : {16, 32, 64}) {
      const MeasuredSphere sphere(base, n);
      for (DomainTriangleId t = 0; t < base.size(); ++t) {
        const double share = region_area(sphere.map, sphere.measures, t) / (4 * kPi) * base.size();
        EXPECT_NEAR(share, 1, 4.0 / n);
      }
    }
  }
}

/// Equation (5) counts source triangles with all corners at home in the two triangles of the path, so it misses up to
/// about a mesh edge at either end of a path of n. And it weights mesh edges, which run up to 30 degrees off the path,
/// by their angles on the domain: that is right for a conformal map, and some percent off for the spheres'.
void expect_about(double length, double arc, int n) {
  EXPECT_GT(length / arc, 1 - 2.2 / n) << "n " << n;
  EXPECT_LT(length / arc, 1.04) << "n " << n;
}

TEST(PathLengths, ApproachTheGreatArcsBetweenTheCornersOfRegularDomains) {
  for (const auto& [base, arc] :
       {std::pair{fixtures::octahedron(), kOctahedronArc}, {fixtures::icosahedron(), kIcosahedronArc}}) {
    for (const int n : {16, 32, 64, 128}) {
      const MeasuredSphere sphere(base, n);
      for (const DomainSide& side : edges(base)) {
        expect_about(path_length(sphere.map, sphere.measures, side), arc, n);
        // Seen from the other triangle it is the same path.
        expect_about(path_length(sphere.map, sphere.measures, base.neighbour(side)), arc, n);
      }
    }
  }
}

TEST(PathLengths, ApproachTheArcsAcrossTwoFacesForTheFlippedEdges) {
  // Twice the arc from a corner to the middle of the side opposite: on the octahedron a quarter turn each; on the
  // icosahedron by Pythagoras on the sphere, cos(half) = cos(arc) / cos(arc / 2).
  const double half = std::acos(std::cos(kIcosahedronArc) / std::cos(kIcosahedronArc / 2));
  for (const auto& [base, across] : {std::pair{fixtures::octahedron(), kPi}, {fixtures::icosahedron(), 2 * half}}) {
    for (const int n : {16, 32, 64, 128}) {
      const MeasuredSphere sphere(base, n);
      for (const DomainSide& side : edges(base)) {
        expect_about(flipped_path_length(sphere.map, sphere.measures, side), across, n);
      }
    }
  }
}

TEST(PathLengths, ScaleWithTheMesh) {
  MeasuredSphere sphere(fixtures::octahedron(), 16);
  const DomainSide side = edges(sphere.map.domain)[0];
  const double length = path_length(sphere.map, sphere.measures, side);
  for (Vec3f& p : sphere.mesh.positions) p *= 4;
  EXPECT_NEAR(path_length(sphere.map, sphere.measures, side), 4 * length, 1e-5);
}

TEST(FlipGain, IsNegativeForEveryEdgeOfARegularDomain) {
  for (const Domain& base : {fixtures::octahedron(), fixtures::icosahedron()}) {
    for (const int n : {8, 16, 32}) {
      const MeasuredSphere sphere(base, n);
      for (const DomainSide& side : edges(base)) EXPECT_LT(flip_gain(sphere.map, sphere.measures, side), 0);
    }
  }
}

TEST(FlipGain, IsMuchLargerForTheWayBackThanForAFlipOfARegularDomain) {
  // Not as large as the flip's cost: the flipped edge stretches the map along it, and (5) takes cosines on the domain,
  // where mesh edges along such a path seem to run across it. That makes an overlong path seem shorter than it is.
  const Domain base = fixtures::icosahedron();
  Scratch scratch;
  int flipped = 0;
  for (const DomainSide& side : edges(base)) {
    MeasuredSphere sphere(base, 16);
    const double there = flip_gain(sphere.map, sphere.measures, side);
    ASSERT_TRUE(can_flip(sphere.map, side));
    // Refused for some: mesh edges that run along the domain's reach through the diamond's corner.
    if (!flip(sphere.map, side, {}, scratch)) continue;
    EXPECT_GT(flip_gain(sphere.map, sphere.measures, side), there + 0.5 * kIcosahedronArc);
    ++flipped;
  }
  EXPECT_GE(flipped, 10);
}

TEST(Measures, AreThoseOfTheEmbeddingWhereRegionsHoldNoVertexAndBlendWhereTheyHoldFew) {
  for (const Domain& base : {fixtures::octahedron(), fixtures::icosahedron()}) {
    MeasuredSphere sphere(base, 16);  // more than enough vertices everywhere
    SurfaceMeasures warming = sphere.measures;
    warming.warming_up = true;
    warming.embedding.assign(base.vertex_count, Vec3d(1e9, 0, 0));
    for (const DomainSide& side : edges(base)) {
      EXPECT_EQ(path_length(sphere.map, warming, side), path_length(sphere.map, sphere.measures, side));
      EXPECT_EQ(region_area(sphere.map, warming, side.triangle),
                region_area(sphere.map, sphere.measures, side.triangle));
    }
    // A map that puts no vertex into any triangle: the lists are emptied.
    for (DomainVertex v = 0; v < base.vertex_count; ++v) {
      warming.embedding[v] = Vec3d(sphere.mesh.positions[sphere.map.anchor[v]]);
    }
    sphere.map.first_in.assign(base.size(), -1);
    for (const DomainSide& side : edges(base)) {
      const Vec3d a = warming.embedding[base.start(side)], b = warming.embedding[base.end(side)];
      const Vec3d c = warming.embedding[base.corner(side.triangle, (side.side + 2) % 3)];
      EXPECT_EQ(path_length(sphere.map, warming, side), (b - a).length());
      EXPECT_NEAR(region_area(sphere.map, warming, side.triangle), (b - a).cross(c - a).length() / 2, 1e-12);
    }
  }
}

}  // namespace
}  // namespace lozenge
