#include "stages/parameterize/map/working_map.h"

#include <gtest/gtest.h>

#include <random>

#include "formats/domain/distortion.h"
#include "formats/domain/sphere_fixtures.h"
#include "stages/parameterize/map/finished.h"
#include "stages/parameterize/map/homes.h"
#include "stages/parameterize/map/images.h"
#include "stages/parameterize/map/walk.h"
#include "stages/parameterize/map_fixtures.h"
#include "stages/parameterize/surface_fixtures.h"

namespace lozenge {
namespace {

TEST(TrivialMap, PutsEveryTriangleOntoADomainTriangleOfItsOwn) {
  const SourceMesh mesh = test::torus(12, 8, 0.4, [](double, double) { return 0.0; });
  const WorkingMap map = trivial_map(mesh.positions, make_halfedge_mesh(mesh.triangles, 96));
  EXPECT_EQ(map.domain_faces, 192);
  for (TriangleId t = 0; t < 192; ++t) EXPECT_NEAR(doubled_image_area(map, t), kHalfRoot3, 1e-12);
  test::expect_whole(map, mesh);
}

TEST(WorkingMap, GivesBackTheParameterizationThatItWasMadeOf) {
  for (const auto& base : {fixtures::tetrahedron(), fixtures::octahedron(), fixtures::icosahedron()}) {
    auto [mesh, map] = fixtures::subdivided_sphere(base, 6);
    fixtures::jitter(map, 0.04, 3);
    const Parameterization back = finished(working_map(mesh, map));
    const Distortion before = measure_distortion(mesh, map);
    const Distortion after = measure_distortion(mesh, back);
    EXPECT_EQ(after.folded_triangles, 0);
    EXPECT_EQ(after.area_sum_error, 0);
    EXPECT_NEAR(after.area, before.area, 1e-9);
    EXPECT_NEAR(after.angle, before.angle, 1e-9);
  }
}

TEST(WorkingMap, SeesEveryImageAsTheExactDevelopmentDoes) {
  for (const auto& base : {fixtures::octahedron(), fixtures::icosahedron()}) {
    auto [mesh, map] = fixtures::subdivided_sphere(base, 7);
    fixtures::jitter(map, 0.04, 5);
    const WorkingMap working = working_map(mesh, map);
    for (TriangleId t = 0; t < working.mesh.triangle_count(); ++t) {
      const auto exact = image_of(mesh, map, t);
      ASSERT_TRUE(exact);
      const double area = static_cast<double>(doubled_area(exact->corners[0], exact->corners[1], exact->corners[2])) /
                          static_cast<double>(kUnitTriangleDoubledArea) * kHalfRoot3;
      EXPECT_NEAR(doubled_image_area(working, t), area, 1e-12);
    }
  }
}

TEST(Walk, EndsWhereTheStraightLineEndsWhateverTrianglesItCrosses) {
  const Domain domain = fixtures::icosahedron();
  std::mt19937 random(17);
  std::uniform_real_distribution<double> share(0.05, 0.45), step(-0.6, 0.6);
  for (int i = 0; i < 500; ++i) {
    const Vec2d from = at_barycentrics(share(random), share(random));
    const Vec2d to = from + Vec2d(step(random), step(random));
    const auto there = walk(domain, 0, from, to);
    ASSERT_TRUE(there);
    const auto w = barycentrics(there->at);
    EXPECT_GE(std::min({w[0], w[1], w[2]}), -1e-12);
    EXPECT_TRUE(there->home != 0 || (there->at - to).length() < 1e-12);
  }
}

TEST(WorkingMap, KeepsTheListsOfItsTrianglesThroughAnyMoves) {
  const auto [mesh, map] = fixtures::subdivided_sphere(fixtures::octahedron(), 5);
  WorkingMap working = working_map(mesh, map);
  std::mt19937 random(23);
  for (int i = 0; i < 2000; ++i) {
    const auto v = static_cast<VertexId>(random() % working.home.size());
    if (working.pin[v] >= 0) continue;
    set_home(working, v, static_cast<DomainTriangleId>(random() % 8), {0.3, 0.2});
  }
  std::vector<int> seen(working.home.size(), 0);
  for (DomainTriangleId t = 0; t < 8; ++t) {
    for (VertexId v = working.first_in[t]; v >= 0; v = working.next_in[v]) {
      EXPECT_EQ(working.home[v], t);
      ++seen[v];
    }
  }
  for (const int count : seen) EXPECT_EQ(count, 1);
}

}  // namespace
}  // namespace lozenge
