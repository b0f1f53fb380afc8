// Collapses, flips and crawling cones: whatever is done, the map stays whole.
#include <gtest/gtest.h>

#include <random>

#include "formats/domain/sphere_fixtures.h"
#include "stages/parameterize/map/finished.h"
#include "stages/parameterize/map/map_energy.h"
#include "stages/parameterize/map/star.h"
#include "stages/parameterize/map_fixtures.h"
#include "stages/parameterize/operations/can_collapse.h"
#include "stages/parameterize/operations/collapse.h"
#include "stages/parameterize/operations/flip.h"
#include "stages/parameterize/operations/warm_up.h"
#include "stages/parameterize/relax/anchor.h"
#include "stages/parameterize/relax/cones.h"
#include "stages/parameterize/relax/global_optimization.h"
#include "stages/parameterize/surface_fixtures.h"

namespace lozenge {
namespace {

constexpr RelaxOptions kFewSweeps{3, 1e-2};

std::vector<DomainSide> living_sides(const WorkingMap& map) {
  std::vector<DomainSide> sides;
  for (DomainTriangleId t = 0; t < map.domain.size(); ++t) {
    for (int s = 0; s < 3 && map.domain.corner(t, 0) >= 0; ++s) sides.push_back({t, s});
  }
  return sides;
}

TEST(Collapse, RemovesTwoTrianglesAndKeepsMapAndTopologyWhole) {
  const SourceMesh mesh = test::sphere(8, test::random_relief(0.3, 1));
  WorkingMap map =
      trivial_map(mesh.positions, make_halfedge_mesh(mesh.triangles, static_cast<int>(mesh.positions.size())));
  SurfaceMeasures measures = trivial_measures(map);
  Scratch scratch;
  std::mt19937 random(5);
  int done = 0;
  while (map.domain_faces > 60) {
    const std::vector<DomainSide> sides = living_sides(map);
    const DomainSide side = sides[random() % sides.size()];
    if (!can_collapse(map, side)) continue;
    const int faces = map.domain_faces;
    const bool collapsed = collapse(map, measures, side, {}, scratch).has_value();
    EXPECT_EQ(map.domain_faces, collapsed ? faces - 2 : faces);
    if (collapsed && ++done % 20 == 0) {
      test::expect_sound(map);
      EXPECT_EQ(euler_characteristic(finished(map).domain), 2);
    }
  }
  test::expect_sound(map);
}

TEST(Collapse, IsRefusedWhereTheTopologyWouldChange) {
  const auto [mesh, fixture] = fixtures::subdivided_sphere(fixtures::tetrahedron(), 4);
  const WorkingMap map = working_map(mesh, fixture);
  for (const DomainSide side : living_sides(map)) EXPECT_FALSE(can_collapse(map, side));
  const SourceMesh torus = test::torus(3, 3, 0.4, [](double, double) { return 0.0; });
  const WorkingMap smallest = trivial_map(torus.positions, make_halfedge_mesh(torus.triangles, 9));
  for (const DomainSide side : living_sides(smallest)) EXPECT_FALSE(can_collapse(smallest, side));
}

TEST(Flip, TwiceGivesTheSameEdgeBackAndKeepsTheMapWhole) {
  const SourceMesh mesh = test::sphere(10, test::random_relief(0.2, 2));
  WorkingMap map = test::decimated_map(mesh, 40);
  Scratch scratch;
  int flipped = 0;
  for (const DomainSide side : living_sides(map)) {
    if (!can_flip(map, side)) continue;
    const DomainVertex a = map.domain.start(side), b = map.domain.end(side);
    if (!flip(map, side, kFewSweeps, scratch)) continue;
    EXPECT_NE(map.domain.start(side), a);
    ASSERT_TRUE(can_flip(map, side));
    if (!flip(map, side, kFewSweeps, scratch)) continue;
    EXPECT_TRUE((map.domain.start(side) == a && map.domain.end(side) == b) ||
                (map.domain.start(side) == b && map.domain.end(side) == a));
    if (++flipped % 10 == 0) test::expect_whole(map, mesh);
    if (flipped == 30) break;
  }
  EXPECT_GT(flipped, 10);
  test::expect_whole(map, mesh);
}

TEST(FlipIfBetter, LowersTheEnergyOrLeavesEveryBitAsItWas) {
  const SourceMesh mesh = test::sphere(10, test::random_relief(0.2, 3));
  WorkingMap map = test::decimated_map(mesh, 40);
  Scratch scratch;
  for (DomainVertex n = 0; n < map.domain.vertex_count; ++n) {
    if (map.corner_of[n].triangle >= 0) ensure_anchor(map, n, scratch);  // else a refused flip may still pin a vertex
  }
  int refused = 0;
  for (const DomainSide side : living_sides(map)) {
    if (!can_flip(map, side)) continue;
    const double before = total_energy(map);
    const auto at = map.at;
    if (flip_if_better(map, side, kFewSweeps, scratch)) {
      EXPECT_LT(total_energy(map), before);
    } else {
      EXPECT_TRUE(at == map.at);
      ++refused;
    }
    if (refused == 20) break;
  }
  EXPECT_GT(refused, 0);
  test::expect_whole(map, mesh);
}

TEST(Collapse, TriedOutLeavesEveryPositionAndTheDomainAsTheyWere) {
  const SourceMesh mesh = test::sphere(10, test::random_relief(0.2, 3));
  WorkingMap map = test::decimated_map(mesh, 40);
  Scratch scratch;
  for (DomainVertex n = 0; n < map.domain.vertex_count; ++n) {
    if (map.corner_of[n].triangle >= 0) ensure_anchor(map, n, scratch);  // else a trial may still pin a vertex
  }
  SurfaceMeasures measures{voronoi_areas(map), std::vector<Vec3d>(map.corner_of.size()), false};
  const WorkingMap before = map;
  int done = 0;
  for (const DomainSide side : living_sides(map)) {
    if (!can_collapse(map, side)) continue;
    const auto operation = [&](LocalChange& change) { return collapse(change, measures, side, {}); };
    done += on_trial(map, scratch, operation).has_value();
    EXPECT_EQ(map.domain_faces, before.domain_faces);
    ASSERT_TRUE(map.at == before.at && map.home == before.home && map.pin == before.pin && map.chart == before.chart);
    ASSERT_TRUE(map.anchor == before.anchor && map.corner_of == before.corner_of);
  }
  EXPECT_GT(done, 10);
}

TEST(OptimizeCone, NeverRaisesTheEnergyAndMovesSomeCones) {
  // The octahedron's own map is far from the best on a relief, and so are its cones.
  const SourceMesh mesh = test::sphere(12, test::random_relief(0.6, 4));
  WorkingMap map = working_map(mesh, fixtures::subdivided_sphere(fixtures::octahedron(), 12).second);
  Scratch scratch;
  int moved = 0;
  for (const double conformality : {0.0, 0.5, 1.0}) {
    map.star_conformality = conformality;
    for (DomainVertex n = 0; n < map.domain.vertex_count; ++n) {
      if (map.corner_of[n].triangle < 0 || valence(map, n).is_regular()) continue;
      const double before = total_energy(map);
      const std::optional<double> rise = optimize_cone(map, n, kFewSweeps, scratch);
      EXPECT_NEAR(total_energy(map) - before, rise.value_or(0), 1e-9);
      EXPECT_LE(rise.value_or(0), 0);
      moved += rise.has_value();
    }
  }
  EXPECT_GT(moved, 0);
  test::expect_whole(map, mesh);
}

TEST(GlobalOptimization, NeverRaisesTheEnergyInTurnOrAtOnceAndEndsNearTheSame) {
  const SourceMesh mesh = test::sphere(12, test::random_relief(0.25, 6));
  const WorkingMap start = test::decimated_map(mesh, 30);
  std::vector<double> ends;
  for (const bool at_once : {false, true}) {
    WorkingMap map = start;
    free_regular_vertices(map);
    GlobalOptions options;
    options.at_once = at_once;
    options.most_epochs = 40;
    options.tolerance = 1e-4;
    const std::vector<double> energies = optimize_globally(map, options);
    for (std::size_t i = 1; i < energies.size(); ++i) EXPECT_LE(energies[i], energies[i - 1] + 1e-12);
    test::expect_whole(map, mesh);
    ends.push_back(energies.back());
  }
  // Cones stop at different vertices, so the ends differ a little.
  EXPECT_NEAR(ends[0] - 1, ends[1] - 1, 0.25 * (ends[1] - 1));
}

TEST(Partitions, LetEveryUnpinnedVertexMoveInOneOfThemWhenTheMeshIsFine) {
  auto [mesh, fixture] = fixtures::subdivided_sphere(fixtures::icosahedron(), 16);
  fixtures::jitter(fixture, 0.01, 1);
  WorkingMap map = working_map(mesh, fixture);
  std::vector<bool> moves(map.home.size(), false);
  for (const Partition p : {Partition::kFaces, Partition::kHalfDiamonds, Partition::kHalfStars}) {
    for (const VertexId v : vertices_inside(map, p)) moves[v] = true;
  }
  for (std::size_t v = 0; v < moves.size(); ++v) EXPECT_TRUE(moves[v] || map.pin[v] >= 0) << v;
}

}  // namespace
}  // namespace lozenge
