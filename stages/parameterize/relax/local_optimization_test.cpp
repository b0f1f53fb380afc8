#include "stages/parameterize/relax/local_optimization.h"

#include <gtest/gtest.h>

#include "formats/domain/sphere_fixtures.h"
#include "stages/parameterize/map/consistency.h"
#include "stages/parameterize/map/finished.h"
#include "stages/parameterize/map/homes.h"
#include "stages/parameterize/map/kernel.h"
#include "stages/parameterize/map/map_energy.h"
#include "stages/parameterize/map_fixtures.h"
#include "stages/parameterize/relax/global_optimization.h"

namespace lozenge {
namespace {

TEST(Relax, LowersTheEnergyBySweepsAndNeverFolds) {
  for (const auto& base : {fixtures::octahedron(), fixtures::icosahedron()}) {
    for (const EnergyKind kind : {EnergyKind::kIsometric, EnergyKind::kMips, EnergyKind::kSymmetricDirichlet}) {
      for (unsigned seed = 0; seed < 4; ++seed) {
        auto [mesh, map] = fixtures::subdivided_sphere(base, 6);
        fixtures::jitter(map, 0.05, seed);
        WorkingMap working = working_map(mesh, map);
        working.energy.kind = kind;
        double before = total_energy(working);
        for (int sweep = 0; sweep < 5; ++sweep) {
          const double fallen = relax(working, vertices_by_triangle(working), {1, 0});
          const double after = total_energy(working);
          EXPECT_LE(after, before + 1e-12);
          EXPECT_NEAR(before - after, fallen, 1e-9) << "the fall that relax reports is the one that happened";
          before = after;
        }
        test::expect_whole(working, mesh);
      }
    }
  }
}

TEST(Relax, LeavesPinnedVerticesWhereTheyAre) {
  auto [mesh, map] = fixtures::subdivided_sphere(fixtures::icosahedron(), 5);
  WorkingMap working = working_map(mesh, map);
  relax(working, vertices_by_triangle(working), {10, 0});
  for (DomainVertex n = 0; n < 12; ++n) {
    ASSERT_GE(working.anchor[n], 0);
    EXPECT_EQ(vertex_at(map.domain, finished(working).phi[working.anchor[n]]) >= 0, true);
  }
}

TEST(PointOfKernel, SeesEverySideOfTheOutlineAndIsNothingWhereNoPointDoes) {
  const std::vector<Vec2d> reflex{{0, 0}, {2, 0}, {2, 2}, {1, 0.5}, {0, 2}};
  const auto p = point_of_kernel(reflex);
  ASSERT_TRUE(p);
  for (std::size_t i = 0; i < reflex.size(); ++i) {
    EXPECT_GT(cross(reflex[i] - *p, reflex[(i + 1) % reflex.size()] - *p), 0);
  }
  const std::vector<Vec2d> horseshoe{{0, 0}, {3, 0}, {3, 3}, {2, 3}, {2, 1}, {1, 1}, {1, 3}, {0, 3}};
  EXPECT_FALSE(point_of_kernel(horseshoe));
}

TEST(HealFolds, TurnsBackWhatAMisplacedVertexFolded) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    auto [mesh, map] = fixtures::subdivided_sphere(fixtures::octahedron(), 8);
    fixtures::jitter(map, 0.02, seed);
    WorkingMap working = working_map(mesh, map);
    std::vector<VertexId> around;
    VertexId folded = -1;
    for (VertexId v = 0; v < working.mesh.vertex_count() && folded < 0; ++v) {
      const auto w = barycentrics(working.at[v]);
      if (working.home[v] == static_cast<int>(seed % 8) && std::min({w[0], w[1], w[2]}) > 0.2) folded = v;
    }
    ASSERT_GE(folded, 0);
    working.at[folded] += Vec2d(0.17, 0.02);  // more than a spacing of 1/8: past its neighbour
    ASSERT_FALSE(is_sound(working, folded));
    around.push_back(folded);
    for_each_outgoing(working.mesh, folded, [&](Halfedge h) { around.push_back(working.mesh.end(h)); });
    EXPECT_TRUE(heal_folds(working, around));
    test::expect_whole(working, mesh);
  }
}

}  // namespace
}  // namespace lozenge
