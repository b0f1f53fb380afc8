#include "stages/parameterize/own_domain.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <utility>

#include "formats/domain/distortion.h"
#include "stages/parameterize/surface_fixtures.h"

namespace lozenge {
namespace {

/// A box with these sides and a diagonal of each face by the seed, turned about an axis.
SourceMesh box(const Vec3d& sides, unsigned seed) {
  std::mt19937 random(seed);
  const double turn = static_cast<double>(random() % 1000) / 1000 * 6;
  SourceMesh mesh;
  for (int i = 0; i < 8; ++i) {
    const Vec3d p((i & 1) * sides.x, (i >> 1 & 1) * sides.y, (i >> 2) * sides.z);
    mesh.positions.emplace_back(static_cast<float>(std::cos(turn) * p.x - std::sin(turn) * p.y),
                                static_cast<float>(std::sin(turn) * p.x + std::cos(turn) * p.y),
                                static_cast<float>(p.z));
  }
  const std::array<std::array<VertexId, 4>, 6> faces{
      {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
  for (const auto& f : faces) {
    if (random() % 2) {
      mesh.triangles.push_back({f[0], f[1], f[2]});
      mesh.triangles.push_back({f[2], f[3], f[0]});
    } else {
      mesh.triangles.push_back({f[1], f[2], f[3]});
      mesh.triangles.push_back({f[3], f[0], f[1]});
    }
  }
  std::shuffle(mesh.triangles.begin(), mesh.triangles.end(), random);
  return mesh;
}

/// The source vertices at the corners of each patch: two domain vertices, two barycentres.
std::set<std::set<VertexId>> patches_of(const Parameterization& map) {
  std::vector<VertexId> at_vertex(map.domain.vertex_count, -1);
  std::vector<VertexId> at_barycentre(map.domain.triangles.size(), -1);
  for (VertexId v = 0; v < static_cast<VertexId>(map.phi.size()); ++v) {
    const DomainVertex n = vertex_at(map.domain, map.phi[v]);
    if (n >= 0) at_vertex[n] = v;
    else at_barycentre[map.phi[v].triangle] = v;
  }
  std::set<std::set<VertexId>> patches;
  for (const DomainSide& side : edges(map.domain)) {
    patches.insert({at_vertex[map.domain.start(side)], at_vertex[map.domain.end(side)], at_barycentre[side.triangle],
                    at_barycentre[map.domain.neighbour(side).triangle]});
  }
  return patches;
}

void expect_exact(const SourceMesh& mesh, const Parameterization& map) {
  EXPECT_EQ(find_defect(map.domain), std::nullopt);
  const Distortion d = measure_distortion(mesh, map);
  EXPECT_EQ(d.folded_triangles, 0);
  EXPECT_EQ(d.area_sum_error, 0);
}

TEST(MapToItsFaces, GivesABoxOfAnyProportionsItsSixFacesAsPatches) {
  std::mt19937 random(5);
  std::normal_distribution<double> exponent(0, 1.5);
  for (unsigned seed = 0; seed < 200; ++seed) {
    const double x = std::exp(exponent(random)), y = std::exp(exponent(random)), z = std::exp(exponent(random));
    const SourceMesh mesh = box(Vec3d(x, y, z), seed);
    const auto map = map_to_its_faces(mesh);
    ASSERT_TRUE(map) << x << " " << y << " " << z;
    EXPECT_EQ(map->domain.size(), 4);
    expect_exact(mesh, *map);
    std::set<std::set<VertexId>> faces{{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                       {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    EXPECT_EQ(patches_of(*map), faces);
  }
}

TEST(MapToItsFaces, PutsCornersOnTheLatticePointNearestToBarycentres) {
  const SourceMesh mesh = box(Vec3d(1, 1, 1), 1);
  const auto map = map_to_its_faces(mesh);
  ASSERT_TRUE(map);
  for (const DomainPoint& p : map->phi) {
    if (vertex_at(map->domain, p) >= 0) continue;
    EXPECT_EQ(p, make_point(p.triangle, 1.0 / 3, 1.0 / 3));
    EXPECT_NEAR(p.gamma(), 1.0 / 3, 1e-12);
  }
  // Squares become rhombi of 60 degrees: s1 / s2 is the root of three.
  EXPECT_NEAR(measure_distortion(mesh, *map).angle, (std::sqrt(3.0) + 1 / std::sqrt(3.0)) / 2 - 1, 1e-6);
}

/// The convex hull of the cube's corners and six points above its faces, where the triangles at each of its edges lie
/// in one plane: twelve rhombi, three at each of the cube's corners and four at each of the others.
SourceMesh rhombic_dodecahedron() {
  SourceMesh mesh = box(Vec3d(2, 2, 2), 0);
  for (int i = 0; i < 8; ++i) mesh.positions[i] = Vec3f(Vec3d((i & 1) * 2 - 1, (i >> 1 & 1) * 2 - 1, (i >> 2) * 2 - 1));
  mesh.triangles.clear();
  const std::array<std::array<VertexId, 4>, 6> faces{
      {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
  for (const auto& f : faces) {
    Vec3f middle(0, 0, 0);
    for (const VertexId v : f) middle += mesh.positions[v] / 4;
    const auto top = static_cast<VertexId>(mesh.positions.size());
    mesh.positions.push_back(middle * 2);
    for (int c = 0; c < 4; ++c) mesh.triangles.push_back({f[c], f[(c + 1) % 4], top});
  }
  return mesh;
}

TEST(MapToItsFaces, KnowsOtherSurfacesOfQuadranglesThatMeetInThrees) {
  const SourceMesh mesh = rhombic_dodecahedron();
  const auto map = map_to_its_faces(mesh);
  ASSERT_TRUE(map);
  EXPECT_EQ(map->domain.size(), 8);
  for (const std::int32_t valence : valences(map->domain)) EXPECT_EQ(valence, 4);
  expect_exact(mesh, *map);
}

TEST(MapToItsFaces, LeavesOtherSurfacesToTheSearch) {
  EXPECT_FALSE(map_to_its_faces(test::sphere(2, [](const Vec3d&) { return 0.0; })));
  EXPECT_FALSE(map_to_its_faces(test::torus(8, 6, 0.4, [](double, double) { return 0.0; })));
  SourceMesh open = box(Vec3d(1, 2, 3), 4);
  open.triangles.resize(10);
  EXPECT_FALSE(map_to_its_faces(open)) << "without all of its faces";
  SourceMesh bent = box(Vec3d(1, 2, 3), 4);
  bent.positions[7] += Vec3f(0.5, 0.5, 0.5);
  EXPECT_FALSE(map_to_its_faces(bent)) << "its faces are far from flat";
  SourceMesh flat = box(Vec3d(1, 2, 0), 4);
  EXPECT_FALSE(map_to_its_faces(flat)) << "of no area";
}

TEST(MapToItself, IsExactForAnySurface) {
  for (const SourceMesh& mesh :
       {test::sphere(2, test::random_relief(0.3, 1)), test::sheet(3, test::random_relief(0.3, 2)),
        test::torus(5, 4, 0.4, [](double, double) { return 0.0; })}) {
    const Parameterization map = map_to_itself(mesh);
    EXPECT_EQ(map.domain.size(), static_cast<std::int32_t>(mesh.triangles.size()));
    expect_exact(mesh, map);
  }
}

}  // namespace
}  // namespace lozenge
