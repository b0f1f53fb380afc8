#include "stages/export/corner_normals.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

#include "formats/domain/sphere_fixtures.h"
#include "formats/patches/source_level.h"
#include "stages/export/charted_scene.h"
#include "stages/export/simplify.h"

namespace lozenge {
namespace {

struct Level {
  ChartedSurface source;
  ChartedSurface level;
};

/// A sphere, or the octahedron inside of it, whose corners carry the normals of its faces; and a level of it.
Level level_of(bool flat, std::int64_t triangles) {
  auto [mesh, map] = fixtures::subdivided_sphere(fixtures::octahedron(), 8);
  const PatchLayout patches = patch_layout(mesh, map, 5);
  const MapLayout layout = make_map_layout(patches, 512, 4);
  Level made;
  made.source = source_level(mesh, map, patches, layout);
  for (Vec3f& p : made.source.positions) {
    if (flat) p /= std::abs(p.x) + std::abs(p.y) + std::abs(p.z);
  }
  for (ChartedTriangle& t : made.source.triangles) {
    Vec3f middle(0, 0, 0);
    for (const ChartedCorner& c : t.corners) middle += made.source.positions[c.vertex];
    const Vec3f face =
        Vec3f(std::copysign(1.0F, middle.x), std::copysign(1.0F, middle.y), std::copysign(1.0F, middle.z));
    for (ChartedCorner& c : t.corners) c.carried = (flat ? face : made.source.positions[c.vertex]).normalized();
  }
  Simplifier simplifier(made.source, chart_scales(layout, patches.size()), 1e-3);
  simplifier.reduce_to(triangles);
  made.level = simplifier.surface();
  return made;
}

Vec3f face_normal(const ChartedSurface& surface, const ChartedTriangle& t) {
  const auto p = [&](int c) { return surface.positions[t.corners[c].vertex]; };
  return (p(1) - p(0)).cross(p(2) - p(0)).normalized();
}

/// The middle of each triangle of the level, shaded as the source is.
std::vector<ShadedPlace> middles(const Level& of, const RayScene& scene) {
  std::vector<ShadedPlace> places;
  for (std::size_t t = 0; t < of.level.triangles.size(); ++t) {
    Vec3d middle(0, 0, 0);
    for (const ChartedCorner& c : of.level.triangles[t].corners) middle += Vec3d(of.level.positions[c.vertex]) / 3;
    const NearestPoint near = scene.nearest(middle);
    Vec3d normal(0, 0, 0);
    for (int c = 0; c < 3; ++c) {
      normal += Vec3d(of.source.triangles[near.triangle].corners[c].carried) * near.weights[c];
    }
    places.push_back({static_cast<TriangleId>(t), Vec3f(1, 1, 1) / 3.0F, Vec3f(normal), 1});
  }
  return places;
}

TEST(CornerNormals, AreThoseOfFacesOnBothSidesOfACrease) {
  Level octahedron = level_of(true, 100);
  const RayScene scene = scene_of(octahedron.source);
  const std::vector<ShadedPlace> places = middles(octahedron, scene);
  set_corner_normals(octahedron.level, places, octahedron.source, scene);
  for (const ChartedTriangle& t : octahedron.level.triangles) {
    for (const ChartedCorner& c : t.corners) EXPECT_GT(c.carried.dot(face_normal(octahedron.level, t)), 0.999);
  }
}

TEST(CornerNormals, AreOneForEachVertexWhereOnlyTheLevelIsCoarse) {
  Level sphere = level_of(false, 24);
  const RayScene scene = scene_of(sphere.source);
  const std::vector<ShadedPlace> places = middles(sphere, scene);
  set_corner_normals(sphere.level, places, sphere.source, scene);
  std::map<VertexId, std::set<std::array<float, 3>>> normals;
  for (const ChartedTriangle& t : sphere.level.triangles) {
    for (const ChartedCorner& c : t.corners) {
      normals[c.vertex].insert({c.carried.x, c.carried.y, c.carried.z});
      EXPECT_NEAR(c.carried.length(), 1, 1e-6);
      EXPECT_GT(c.carried.dot(sphere.level.positions[c.vertex].normalized()), 0.9);
    }
  }
  for (const auto& [vertex, of] : normals) EXPECT_EQ(of.size(), 1U) << "vertex " << vertex;
}

}  // namespace
}  // namespace lozenge
