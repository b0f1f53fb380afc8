#include "stages/parameterize/parts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "formats/domain/distortion.h"
#include "formats/surface/attribute_fixtures.h"
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
  const MappedPart whole = join_parts(std::move(mapped));
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
  fixtures::expect_planted_attributes(join_parts(std::move(mapped)).surface);
}

TEST(Allot, SharesByAreaAndGivesNoPartLessThanItsTopologyNeeds) {
  std::vector<Part> parts =
      split_into_parts(test::beside(ball(8), test::torus(12, 6, 0.4, [](double, double) { return 0.0; }), 5));
  ASSERT_EQ(parts.size(), 2U);
  parts[0].area = 3;
  parts[1].area = 1;
  const std::vector<Allotment> even = allot(parts, 100, 200);
  EXPECT_EQ(even[0].min_faces, 75);
  EXPECT_EQ(even[0].max_faces, 150);
  EXPECT_EQ(even[1].min_faces, 25);
  EXPECT_EQ(even[1].max_faces, 50);
  // The torus needs fourteen.
  const std::vector<Allotment> few = allot(parts, 8, 12);
  EXPECT_EQ(few[1].min_faces, 14);
  EXPECT_FALSE(few[1].is_itself);
}

TEST(Allot, LeavesTinyPartsAsTheyAre) {
  std::vector<Part> parts = split_into_parts(test::beside(ball(8), ball(1), 4));
  parts[0].area = 1000;
  parts[1].area = 1;
  EXPECT_TRUE(allot(parts, 100, 200)[1].is_itself);
  EXPECT_EQ(allot(parts, 100, 200)[1].max_faces, 8);
  parts[1].area = 1000;  // as large as the other one: no reason to be coarse
  EXPECT_FALSE(allot(parts, 100, 200)[1].is_itself);
}

/// Of a part three times as large as the other one.
std::int32_t best_size_beside(const Allotment& other, const std::vector<TraceRow>& trace) {
  std::vector<Part> parts = split_into_parts(test::beside(ball(3), ball(3), 4));
  parts[0].area = 3;
  parts[1].area = 1;
  const std::vector<Allotment> shares{{20, 60}, other};
  const auto best = std::min_element(trace.begin(), trace.end(), [&](const TraceRow& a, const TraceRow& b) {
    return weighed_whole(parts, shares, 0, a) < weighed_whole(parts, shares, 0, b);
  });
  return best->domain_faces;
}

TEST(WeighedWhole, IsLeastAtTheLargestPartsOwnBestWhereOthersCanFollow) {
  EXPECT_EQ(best_size_beside({5, 20}, {{60, 0.01, 0.1, 0, 0}, {40, 0.02, 0.2, 0, 0}, {20, 0.05, 1, 0, 0}}), 60);
  EXPECT_EQ(best_size_beside({5, 20}, {{60, 0.01, 0.1, 0, 0}, {40, 0.01, 0.1, 0, 0}, {20, 0.01, 0.1, 0, 0}}), 20);
}

TEST(WeighedWhole, IsLeastAtALargerSizeWhereAnotherPartNeedsMore) {
  // At 20 the other one would have triangles a third as large.
  EXPECT_EQ(best_size_beside({20, 21}, {{60, 0.01, 0.1, 0, 0}, {40, 0.01, 0.1, 0, 0}, {20, 0.01, 0.1, 0, 0}}), 60);
}

}  // namespace
}  // namespace lozenge
