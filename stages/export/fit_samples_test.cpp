#include "stages/export/fit_samples.h"

#include <gtest/gtest.h>

#include "formats/domain/sphere_fixtures.h"
#include "formats/patches/source_level.h"
#include "stages/export/charted_scene.h"

namespace lozenge {
namespace {

struct Sphere {
  ChartedSurface surface;
  FitPatches patches;
};

Sphere make_sphere() {
  const auto [mesh, map] = fixtures::subdivided_sphere(fixtures::octahedron(), 6);
  const PatchLayout layout = patch_layout(mesh, map, 5);
  const auto count = static_cast<std::size_t>(layout.size());
  return {source_level(mesh, map, layout, make_map_layout(layout, 512, 4)),
          {std::vector<std::int32_t>(count, 0), std::vector<bool>(count, false)}};
}

TEST(FitSamples, AreInTheVerySamePlaceWhereTheLevelIsTheSource) {
  const Sphere sphere = make_sphere();
  for (const bool slipped : {false, true}) {
    FitPatches patches = sphere.patches;
    patches.slipped.assign(patches.slipped.size(), slipped);
    const std::vector<FitSample> samples = samples_of_source(sphere.surface, sphere.surface, patches);
    EXPECT_GE(samples.size(), sphere.surface.triangles.size());
    for (const FitSample& s : samples) {
      Vec3d at(0, 0, 0);
      for (int k = 0; k < 3; ++k) at += Vec3d(sphere.surface.positions[s.vertices[k]]) * s.weights[k];
      EXPECT_LT((at - Vec3d(s.position)).length(), 1e-6);
    }
  }
}

TEST(FitSamples, OfALevelAreHeldAgainstWhatFacesTheirWayThoughSomethingElseIsNearer) {
  const Sphere sphere = make_sphere();
  ChartedSurface turned = sphere.surface;
  for (ChartedTriangle& t : turned.triangles) std::swap(t.corners[1], t.corners[2]);
  const SamplesOfLevel found = samples_of_level(turned, sphere.surface, scene_of(sphere.surface), sphere.patches);
  EXPECT_EQ(found.samples.size(), 4 * turned.triangles.size());
  for (const FitSample& s : found.samples) {
    // Inwards: what does begins a right angle away, in triangles of 15 degrees, of edges at most 22.
    const Vec3f own = (turned.positions[s.vertices[0]] + turned.positions[s.vertices[1]]) / 2;
    EXPECT_LT(s.position.dot(own), 0.4);
  }
}

TEST(FitSamples, OfATriangleThatFacesNoWayThereAreNone) {
  const Sphere sphere = make_sphere();
  ChartedSurface level = sphere.surface;
  // As collapses leave them: with three vertices, at one place.
  const auto& corners = level.triangles.front().corners;
  for (int k = 1; k < 3; ++k) level.positions[corners[k].vertex] = level.positions[corners[0].vertex];
  const SamplesOfLevel found = samples_of_level(level, sphere.surface, scene_of(sphere.surface), sphere.patches);
  EXPECT_EQ(found.samples.size(), found.shaded.size());
  for (const ShadedPlace& place : found.shaded) EXPECT_NE(place.triangle, 0);
  EXPECT_LT(found.samples.size(), 4 * level.triangles.size());
}

}  // namespace
}  // namespace lozenge
