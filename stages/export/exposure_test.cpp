#include "stages/export/exposure.h"

#include <gtest/gtest.h>

#include "formats/domain/sphere_fixtures.h"
#include "stages/export/charted_scene.h"

namespace lozenge {
namespace {

/// Spheres around the origin, one inside of the other.
ChartedSurface spheres(const std::vector<float>& radii) {
  const SourceMesh mesh = fixtures::subdivided_sphere(fixtures::icosahedron(), 4).first;
  ChartedSurface surface;
  for (const float radius : radii) {
    const auto first = static_cast<VertexId>(surface.positions.size());
    for (const Vec3f& p : mesh.positions) surface.positions.push_back(p * radius);
    for (const auto& vertices : mesh.triangles) {
      ChartedTriangle& t = surface.triangles.emplace_back();
      for (int k = 0; k < 3; ++k) t.corners[k].vertex = first + vertices[k];
    }
  }
  return surface;
}

TEST(Exposure, IsWholeOnAConvexSurfaceAndATenthInside) {
  const ChartedSurface surface = spheres({1, 0.5F});
  const std::vector<float> exposure = exposure_of(surface, scene_of(surface));
  ASSERT_EQ(exposure.size(), surface.triangles.size());
  for (std::size_t t = 0; t < exposure.size(); ++t) {
    EXPECT_FLOAT_EQ(exposure[t], t < exposure.size() / 2 ? 1.0F : 0.1F) << t;
  }
}

TEST(Exposure, IsThatOfTheSideThatSeesMore) {
  ChartedSurface inside_out = spheres({1});
  for (ChartedTriangle& t : inside_out.triangles) std::swap(t.corners[1], t.corners[2]);
  for (const float share : exposure_of(inside_out, scene_of(inside_out))) EXPECT_FLOAT_EQ(share, 1.0F);
}

}  // namespace
}  // namespace lozenge
