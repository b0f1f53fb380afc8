#include "stages/sample/sample_count.h"

#include <gtest/gtest.h>

#include <cmath>

#include "formats/base/error.h"
#include "formats/domain/open_fixtures.h"
#include "formats/domain/sphere_fixtures.h"
#include "formats/patches/level_mesh.h"
#include "stages/sample/sample.h"

namespace lozenge {
namespace {

/// A square of two domain triangles, flat.
fixtures::OpenSurface square() {
  fixtures::OpenSurface flat;
  flat.mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  flat.mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  flat.map = {make_domain({{0, 1, 2}, {0, 2, 3}}, 4), {{0, 1, 0}, {0, 0, 1}, {0, 0, 0}, {1, 0, 0}}};
  return flat;
}

TEST(ChooseSamples, TakesTheFewestWhereTheSurfaceIsFlat) {
  const fixtures::OpenSurface flat = square();
  const SampleChoice choice = choose_samples(PatchSampler(flat.mesh, flat.map), 0, {});
  EXPECT_EQ(choice.samples, 2);
  EXPECT_LT(choice.deviation, 1e-6);
}

TEST(ChooseSamples, TakesTheFewestThatHoldTheSourceToTheError) {
  const auto [mesh, map] = fixtures::subdivided_sphere(fixtures::icosahedron(), 40);
  for (const double error : {0.5, 0.1, 0.02}) {
    const SampleChoice choice = choose_samples(PatchSampler(mesh, map), error, {});
    EXPECT_LE(choice.deviation, error);
    // Half as many would not have done.
    ASSERT_GT(choice.samples, 2);
    const SampleChoice looser = choose_samples(PatchSampler(mesh, map), 5 * error, {});
    EXPECT_LT(looser.samples, choice.samples);
    EXPECT_GT(looser.deviation, error);
  }
  EXPECT_LT(choose_samples(PatchSampler(mesh, map), 2, {}).samples,
            choose_samples(PatchSampler(mesh, map), 0.02, {}).samples);
}

TEST(ChooseSamples, MeasuresHowFarTheMeshIsFromTheSurface) {
  const auto [mesh, map] = fixtures::subdivided_sphere(fixtures::octahedron(), 64);
  const SampleChoice choice = choose_samples(PatchSampler(mesh, map), 0.3, {});
  const PatchSet patches = sample(mesh, map, {choice.samples});
  const LevelMesh level = patch_mesh(patches);
  double squares = 0;
  double areas = 0;
  for (const auto& [a, b, c] : level.triangles) {
    const Vec3d corners[3]{Vec3d(level.positions[a]), Vec3d(level.positions[b]), Vec3d(level.positions[c])};
    const double area = (corners[1] - corners[0]).cross(corners[2] - corners[0]).length();
    constexpr int kSteps = 8;
    double sum = 0;
    int count = 0;
    for (int i = 0; i <= kSteps; ++i) {
      for (int j = 0; i + j <= kSteps; ++j, ++count) {
        const Vec3d p = (corners[0] * i + corners[1] * j + corners[2] * (kSteps - i - j)) / kSteps;
        sum += std::pow(1 - p.length(), 2);
      }
    }
    squares += area * sum / count;
    areas += area;
  }
  const double percent = 100 * std::sqrt(squares / areas) / diagonal(bounds_of(mesh.positions));
  EXPECT_NEAR(choice.deviation, percent, 0.25 * percent);
}

TEST(ChooseSamples, TakesNoMoreThanTheSourceIsWorth) {
  for (const int n : {2, 5, 12}) {
    auto [mesh, map] = fixtures::subdivided_sphere(fixtures::icosahedron(), n);
    // A surface that no number of samples holds to nothing at all.
    const PatchSet patches = sample(mesh, map, {.samples = 0, .error = 0});
    EXPECT_LE(static_cast<std::int64_t>(patch_mesh(patches).triangles.size()),
              worthwhile_triangles(static_cast<std::int64_t>(mesh.triangles.size())));
    EXPECT_TRUE(patches.layout.deviation.has_value());
  }
}

TEST(ChooseSamples, RefusesAnErrorThatIsNoDistance) {
  const fixtures::OpenSurface flat = square();
  for (const double wrong : {-1.0, std::nan(""), double{INFINITY}}) {
    EXPECT_THROW(choose_samples(PatchSampler(flat.mesh, flat.map), wrong, {}), Error);
  }
}

}  // namespace
}  // namespace lozenge
