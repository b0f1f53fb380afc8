#include "stages/export/outline.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace lozenge {
namespace {

/// A prism with a regular polygon of `sides` corners on the unit circle, of the given length, open at its ends.
ChartedSurface rod(int sides, double length) {
  ChartedSurface surface;
  for (int i = 0; i < sides; ++i) {
    const double turn = 2 * std::numbers::pi * i / sides;
    for (const double z : {0.0, length}) {
      surface.positions.emplace_back(Vec3f(Vec3d(std::cos(turn), std::sin(turn), z)));
    }
  }
  const auto add = [&](VertexId a, VertexId b, VertexId c) {
    ChartedTriangle& t = surface.triangles.emplace_back();
    t.patch = 0;
    t.corners[0].vertex = a;
    t.corners[1].vertex = b;
    t.corners[2].vertex = c;
  };
  for (int i = 0; i < sides; ++i) {
    const VertexId a = 2 * i;
    const VertexId b = 2 * ((i + 1) % sides);
    add(a, b, b + 1);
    add(a, b + 1, a + 1);
  }
  return surface;
}

std::vector<float> all_seen(const ChartedSurface& surface) {
  return std::vector<float>(surface.triangles.size(), 1.0F);
}

/// The sum over edges along the rod, not around its ends.
double along(const ChartedSurface& surface, const std::vector<OutlineEdge>& edges) {
  double sum = 0;
  for (const OutlineEdge& edge : edges) {
    const auto& corners = surface.triangles[edge.triangle].corners;
    const Vec3f way =
        surface.positions[corners[(edge.side + 1) % 3].vertex] - surface.positions[corners[edge.side].vertex];
    if (way.z != 0) sum += edge.weight;
  }
  return sum;
}

TEST(OutlineEdges, OfARodWeighItsTwoOutlinesHoweverManySidesItHas) {
  for (const int sides : {3, 4, 7, 50}) {
    const ChartedSurface surface = rod(sides, 5);
    const double width = 0.25;
    EXPECT_NEAR(along(surface, outline_edges(surface, all_seen(surface), width)), 2 * 5 * width, 1e-5) << sides;
  }
}

TEST(OutlineEdges, LieAroundTheEndsOfASurfaceInAllViews) {
  const ChartedSurface surface = rod(6, 1);
  int ends = 0;
  for (const OutlineEdge& edge : outline_edges(surface, all_seen(surface), 1)) {
    const auto& corners = surface.triangles[edge.triangle].corners;
    const Vec3f a = surface.positions[corners[edge.side].vertex];
    const Vec3f b = surface.positions[corners[(edge.side + 1) % 3].vertex];
    if (a.z != b.z) continue;
    ++ends;
    EXPECT_NEAR(edge.weight, (b - a).length(), 1e-6);
    EXPECT_NEAR(edge.normals[1].z, a.z == 0 ? -1 : 1, 1e-6) << "out of the surface, along it";
  }
  EXPECT_EQ(ends, 12);
}

TEST(OutlineEdges, AreNoneInValleysAndOfWhatIsHidden) {
  ChartedSurface inside_out = rod(6, 1);
  for (ChartedTriangle& t : inside_out.triangles) std::swap(t.corners[1], t.corners[2]);
  EXPECT_EQ(along(inside_out, outline_edges(inside_out, all_seen(inside_out), 1)), 0);
  const ChartedSurface surface = rod(6, 1);
  const std::vector<float> unseen(surface.triangles.size(), 0.0F);
  EXPECT_EQ(along(surface, outline_edges(surface, unseen, 1)), 0);
}

}  // namespace
}  // namespace lozenge
