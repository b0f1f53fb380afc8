#include "stages/export/level_deviation.h"

#include <gtest/gtest.h>

#include "formats/domain/sphere_fixtures.h"
#include "formats/patches/source_level.h"
#include "stages/export/charted_scene.h"

namespace lozenge {
namespace {

TEST(DeviationMeter, MeasuresHowFarALevelLiesFromTheSource) {
  const auto [mesh, map] = fixtures::subdivided_sphere(fixtures::icosahedron(), 12);
  const PatchLayout patches = patch_layout(mesh, map, 5);
  const MapLayout layout = make_map_layout(patches, 512, 4);
  const ChartedSurface source = source_level(mesh, map, patches, layout);
  const RayScene scene = scene_of(source);
  const DeviationMeter meter(source, scene, patches, nullptr);
  EXPECT_EQ(meter.of_source().whole.largest, 0);
  EXPECT_NEAR(meter.of_source().whole.extent, 2 * std::sqrt(3.0), 0.05) << "of the unit sphere's box";
  for (const double distance : {0.25, 0.02}) {
    ChartedSurface level = source;
    for (Vec3f& p : level.positions) p = p * static_cast<float>(1 + distance);
    const LevelDeviations found = meter.of(level, framed_surface(level, layout), nullptr);
    EXPECT_NEAR(found.whole.mean, distance, 0.02 * distance + 1e-3);
    EXPECT_NEAR(found.whole.largest, distance, 0.02 * distance + 5e-3);
    EXPECT_FALSE(found.whole.normals) << "no map says what they should be";
    ASSERT_EQ(found.bodies.size(), 1U);
    EXPECT_EQ(found.bodies[0].largest, found.whole.largest) << "all stands still";
  }
}

}  // namespace
}  // namespace lozenge
