// Sweeps on all threads, Newton's method on all vertices, crawling cones, splits of the domain: whatever is done, the
// energy falls and the map stays whole.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <random>

#include "formats/domain/sphere_fixtures.h"
#include "stages/parameterize/map/map_energy.h"
#include "stages/parameterize/map/star.h"
#include "stages/parameterize/map_fixtures.h"
#include "stages/parameterize/operations/split.h"
#include "stages/parameterize/relax/crawl.h"
#include "stages/parameterize/relax/global_optimization.h"
#include "stages/parameterize/relax/newton.h"
#include "stages/parameterize/relax/sweeps.h"
#include "stages/parameterize/surface_fixtures.h"

namespace lozenge {
namespace {

/// A map far from settled: a sphere's, jittered.
WorkingMap jittered_map(const SourceMesh& mesh, Parameterization map, unsigned seed, double by = 0.02) {
  fixtures::jitter(map, by, seed);
  return working_map(mesh, map);
}

TEST(RelaxAll, GivesTheSameBitsOnOneThreadAndOnSeveral) {
  // More vertices than a block holds, so that there are vertices between blocks.
  const auto [mesh, map] = fixtures::subdivided_sphere(fixtures::icosahedron(), 32);
  std::vector<std::vector<Vec2d>> ends;
  for (const std::size_t threads : {1, 2, 4}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    WorkingMap working = jittered_map(mesh, map, 1, 0.006);
    const double before = total_energy(working);
    const double fallen = relax_all(working, {6, 0});
    EXPECT_NEAR(before - total_energy(working), fallen, 1e-9);
    EXPECT_GT(fallen, 0);
    test::expect_whole(working, mesh);
    ends.push_back(working.at);
  }
  EXPECT_EQ(ends[0], ends[1]);
  EXPECT_EQ(ends[0], ends[2]);
}

TEST(NewtonAll, EndsAtLeastAsLowAsManySweepsForEveryEnergy) {
  for (const auto& base : {fixtures::octahedron(), fixtures::icosahedron()}) {
    for (const EnergyKind kind : {EnergyKind::kIsometric, EnergyKind::kMips, EnergyKind::kSymmetricDirichlet}) {
      const auto [mesh, map] = fixtures::subdivided_sphere(base, 8);
      WorkingMap swept = jittered_map(mesh, map, 2);
      swept.energy.kind = kind;
      WorkingMap working = swept;
      relax_all(swept, {200, 0});
      const double before = total_energy(working);
      const double fallen = newton_all(working, {60, 1e-9});
      EXPECT_NEAR(before - total_energy(working), fallen, 1e-9);
      EXPECT_LE(total_energy(working) - 1, 1.001 * (total_energy(swept) - 1));
      test::expect_whole(working, mesh);
    }
  }
}

TEST(NewtonAll, LeavesPinnedVerticesAndASettledMapWhereTheyAre) {
  const auto [mesh, map] = fixtures::subdivided_sphere(fixtures::icosahedron(), 8);
  WorkingMap working = jittered_map(mesh, map, 3);
  newton_all(working, {60, 0});
  const WorkingMap settled = working;
  EXPECT_LT(newton_all(working, {1, 0}), 1e-9);
  for (VertexId v = 0; v < working.mesh.vertex_count(); ++v) {
    EXPECT_EQ(working.pin[v], settled.pin[v]);
    EXPECT_LT((working.at[v] - settled.at[v]).length(), 1e-4);
  }
}

TEST(Crawl, LowersTheEnergyAndTakesConesBackTowardsWhereTheyBelong) {
  // The octahedron's own map on a sphere is right; a relief moves its cones off their best places.
  const SourceMesh mesh = test::sphere(12, test::random_relief(0.6, 4));
  WorkingMap map = working_map(mesh, fixtures::subdivided_sphere(fixtures::octahedron(), 12).second);
  newton_all(map, {});
  Scratch scratch;
  int moved = 0;
  for (int round = 0; round < 3; ++round) {
    for (DomainVertex n = 0; n < map.domain.vertex_count; ++n) {
      const double before = total_energy(map);
      const std::optional<double> rise = crawl(map, n, scratch);
      EXPECT_NEAR(total_energy(map) - before, rise.value_or(0), 1e-9);
      EXPECT_LE(rise.value_or(0), 0);
      moved += rise.has_value();
    }
  }
  EXPECT_GT(moved, 0);
  test::expect_whole(map, mesh);
}

TEST(Crawl, LeavesTheUsersConesAlone) {
  const SourceMesh mesh = test::sphere(12, test::random_relief(0.6, 4));
  WorkingMap map = working_map(mesh, fixtures::subdivided_sphere(fixtures::octahedron(), 12).second);
  map.kept.assign(map.kept.size(), 1);
  const std::vector<VertexId> anchors = map.anchor;
  crawl_all(map, 3);
  EXPECT_EQ(map.anchor, anchors);
}

TEST(Split, AddsTwoTrianglesAndCanBeTakenBackBitByBit) {
  const SourceMesh mesh = test::sphere(12, test::random_relief(0.3, 9));
  WorkingMap map = test::decimated_map(mesh, 60);
  Scratch scratch;
  std::mt19937 random(3);
  int done = 0;
  for (int attempt = 0; attempt < 4000 && done < 12; ++attempt) {
    const DomainSide side{static_cast<DomainTriangleId>(random() % map.domain.triangles.size()),
                          static_cast<int>(random() % 3)};
    if (map.domain.corner(side.triangle, 0) < 0 || !can_split(map, side)) continue;
    const WorkingMap before = map;
    LocalChange change(map, scratch);
    const auto made = split(change, side, {4, 1e-2});
    if (!made) continue;
    EXPECT_EQ(map.domain_faces, before.domain_faces + 2);
    EXPECT_EQ(valence(map, made->vertex).triangles, 4);
    test::expect_sound(map);
    if (++done % 2 == 1) {
      change.commit();
    } else {
      change.take_back();
      EXPECT_EQ(map.domain_faces, before.domain_faces);
      // But for vertices that were pinned to make room, which a refusal may leave pinned.
      EXPECT_EQ(map.home.size(), before.home.size());
      test::expect_sound(map);
    }
  }
  EXPECT_GE(done, 6);
}

}  // namespace
}  // namespace lozenge
