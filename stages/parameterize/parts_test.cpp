#include "stages/parameterize/parts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "formats/domain/distortion.h"
#include "formats/surface/attribute_fixtures.h"
#include "stages/parameterize/own_domain.h"
#include "stages/parameterize/surface_fixtures.h"

namespace lozenge {
namespace {

SourceMesh ball(int n) {
  return test::sphere(n, [](const Vec3d&) { return 0.0; });
}

TEST(Parts, ArePiecesThatHangTogetherAndKeepTheirCorners) {
  SourceMesh mesh = test::beside(ball(3), ball(1), 4);
  for (std::size_t i = 0; i < 3 * mesh.triangles.size(); ++i) {
    fixtures::add_corner(mesh, kTextureCoordinates, Vec2f(static_cast<float>(i), 0.0F));
  }
  EXPECT_FALSE(is_connected(mesh));
  EXPECT_TRUE(is_connected(ball(3)));
  const std::vector<Part> parts = split_into_parts(mesh);
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_EQ(parts[0].mesh.triangles.size(), 72U);
  EXPECT_EQ(parts[1].mesh.triangles.size(), 8U);
  EXPECT_GT(parts[0].area, parts[1].area);
  std::size_t corner = 0;
  for (const Part& part : parts) {
    for (std::size_t t = 0; t < part.mesh.triangles.size(); ++t) {
      for (int c = 0; c < 3; ++c, ++corner) {
        const VertexId whole = part.vertices[part.mesh.triangles[t][c]];
        EXPECT_EQ(whole, mesh.triangles[corner / 3][corner % 3]);
        EXPECT_EQ(part.mesh.positions[part.mesh.triangles[t][c]], mesh.positions[whole]);
        EXPECT_EQ(fixtures::corner_uvs(part.mesh)[3 * t + c].x, static_cast<float>(corner));
      }
    }
  }
}

TEST(Parts, AreJoinedToWhatTheyWere) {
  const SourceMesh mesh = test::beside(ball(2), ball(1), 4);
  std::vector<MappedPart> mapped;
  for (Part& part : split_into_parts(mesh)) {
    Parameterization map = map_to_itself(part.mesh);
    mapped.push_back({std::move(part.mesh), std::move(map)});
  }
  const MappedPart whole = join_parts(std::move(mapped), mesh);
  EXPECT_EQ(whole.surface.triangles.size(), mesh.triangles.size());
  EXPECT_EQ(whole.surface.positions.size(), mesh.positions.size());
  EXPECT_EQ(find_defect(whole.map.domain), std::nullopt);
  EXPECT_EQ(whole.map.domain.size(), static_cast<std::int32_t>(mesh.triangles.size()));
  const Distortion d = measure_distortion(whole.surface, whole.map);
  EXPECT_EQ(d.folded_triangles, 0);
  EXPECT_EQ(d.area_sum_error, 0);
}

TEST(Parts, CarryAttributesThatTheyKnowNothingOf) {
  SourceMesh mesh = test::beside(ball(2), ball(1), 4);
  fixtures::plant_attributes(mesh);
  std::vector<MappedPart> mapped;
  for (Part& part : split_into_parts(mesh)) {
    fixtures::expect_planted_attributes(part.mesh);
    Parameterization map = map_to_itself(part.mesh);
    mapped.push_back({std::move(part.mesh), std::move(map)});
  }
  fixtures::expect_planted_attributes(join_parts(std::move(mapped), mesh).surface);
}

TEST(Parts, AreJoinedWithTheLargestScaleFirstAndKeepTheirPlacesInTheSurface) {
  const SourceMesh mesh = test::beside(test::beside(ball(2), ball(1), 4), ball(3), 8);
  std::vector<MappedPart> mapped;
  const std::vector<std::int32_t> levels{2, 0, 1};
  for (Part& part : split_into_parts(mesh)) {
    Parameterization map = map_to_itself(part.mesh);
    mapped.push_back({std::move(part.mesh), std::move(map), levels[mapped.size()]});
  }
  const MappedPart whole = join_parts(std::move(mapped), mesh);
  EXPECT_EQ(whole.surface.positions, mesh.positions);
  EXPECT_EQ(whole.surface.triangles, mesh.triangles);
  EXPECT_EQ(find_defect(whole.map.domain), std::nullopt);
  EXPECT_EQ(find_first_level_defect(whole.map.domain, whole.map.first_levels), std::nullopt);
  EXPECT_TRUE(std::is_sorted(whole.map.first_levels.begin(), whole.map.first_levels.end()));
  EXPECT_EQ(whole.map.first_level(whole.map.phi[0].triangle), 2) << "the first part's";
  const Distortion d = measure_distortion(whole.surface, whole.map);
  EXPECT_EQ(d.folded_triangles, 0);
  EXPECT_EQ(d.area_sum_error, 0);
}

}  // namespace
}  // namespace lozenge
