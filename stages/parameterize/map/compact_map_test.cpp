// A compact copy holds the same map, and sweeps over it are sweeps over the whole.
#include "stages/parameterize/map/compact_map.h"

#include <gtest/gtest.h>

#include "stages/parameterize/levels/coarsen.h"
#include "stages/parameterize/levels/refine.h"
#include "stages/parameterize/map/map_energy.h"
#include "stages/parameterize/map_fixtures.h"
#include "stages/parameterize/relax/crawl.h"
#include "stages/parameterize/relax/sweeps.h"
#include "stages/parameterize/surface_fixtures.h"

namespace lozenge {
namespace {

/// A map whose mesh has gaps: vertices were removed while its domain was decimated.
WorkingMap map_with_gaps(const SourceMesh& mesh) {
  std::vector<Removal> removals;
  WorkingMap map = test::decimated_map(mesh, 60, &removals);
  EXPECT_FALSE(removals.empty());
  return map;
}

TEST(CompactMap, HasTheSameEnergyWithoutGaps) {
  const SourceMesh mesh = test::sphere(24, test::random_relief(0.2, 3));
  const WorkingMap whole = map_with_gaps(mesh);
  CompactMap compact(whole);
  EXPECT_LT(compact.map().mesh.triangle_count(), whole.mesh.triangle_count());
  for (TriangleId t = 0; t < compact.map().mesh.triangle_count(); ++t) EXPECT_FALSE(compact.map().mesh.removed(t));
  for (const DomainTriangleId home : compact.map().home) EXPECT_GE(home, 0);
  EXPECT_NEAR(total_energy(compact.map()), total_energy(whole), 1e-12 * total_energy(whole));
}

TEST(CompactMap, BringsBackWhatASweepOverItDid) {
  const SourceMesh mesh = test::sphere(24, test::random_relief(0.2, 4));
  WorkingMap whole = map_with_gaps(mesh);
  const double before = total_energy(whole);
  CompactMap compact(whole);
  const double fallen = relax_all(compact.map(), {3, 1e-3});
  EXPECT_GT(fallen, 0);
  compact.write_back(whole);
  test::expect_sound(whole);
  EXPECT_NEAR(total_energy(whole), total_energy(compact.map()), 1e-12 * before);
  EXPECT_LT(total_energy(whole), before);
}

TEST(CompactMap, BringsBackWhereConesCrawled) {
  const SourceMesh mesh = test::sphere(24, test::random_relief(0.3, 5));
  WorkingMap whole = map_with_gaps(mesh);
  whole.energy.gamma = 0;  // cones that lie well for one energy don't for another
  CompactMap compact(whole);
  relax_all(compact.map(), {20, 1e-3});
  crawl_all(compact.map(), 3);
  compact.write_back(whole);
  test::expect_sound(whole);
  EXPECT_NEAR(total_energy(whole), total_energy(compact.map()), 1e-12 * total_energy(whole));
  int moved = 0;
  const WorkingMap before = map_with_gaps(mesh);
  for (std::size_t n = 0; n < whole.anchor.size(); ++n) {
    moved += whole.anchor[n] != before.anchor[n];
    if (whole.anchor[n] >= 0) {
      EXPECT_EQ(whole.pin[whole.anchor[n]], static_cast<DomainVertex>(n));
    }
  }
  EXPECT_GT(moved, 0);
}

}  // namespace
}  // namespace lozenge
