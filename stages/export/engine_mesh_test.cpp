#include "stages/export/engine_mesh.h"

#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include <algorithm>
#include <array>
#include <set>

#include "stages/export/export_fixtures.h"

namespace lozenge {
namespace {

MapLayout layout_for(const GeometryImage& image) { return make_map_layout(image.layout, 512, 2); }

/// Everything about a triangle's corners, starting with its smallest, so that order doesn't matter.
using Corner = std::array<float, 12>;
std::multiset<std::array<Corner, 3>> triangles_of(const EngineMesh& mesh) {
  std::multiset<std::array<Corner, 3>> triangles;
  for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
    std::array<Corner, 3> corners{};
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t v = mesh.indices[t + k];
      const Vec3f& p = mesh.positions[v];
      const Vec3f& n = mesh.normals[v];
      const Vec4f& g = mesh.tangents[v];
      corners[k] = {p.x, p.y, p.z, n.x, n.y, n.z, g.x, g.y, g.z, g.w, mesh.texcoords[v].x, mesh.texcoords[v].y};
    }
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    triangles.insert(corners);
  }
  return triangles;
}

float cache_misses_per_triangle(const EngineMesh& mesh) {
  return meshopt_analyzeVertexCache(mesh.indices.data(), mesh.indices.size(), mesh.positions.size(), 16, 0, 0).acmr;
}

TEST(EngineMesh, HasAsManyTrianglesAsAreCounted) {
  for (const GeometryImage& image :
       {export_fixtures::octahedron(17), export_fixtures::two_spheres(9), export_fixtures::open_octahedron(9)}) {
    for (int level = 0; level < static_cast<int>(image.levels.size()); ++level) {
      EXPECT_EQ(engine_mesh(image, level, layout_for(image), level).triangle_count(),
                image.layout.count_triangles(level));
    }
  }
}

TEST(OrderForGpu, KeepsEveryTriangleAndItsAttributes) {
  for (const GeometryImage& image : {export_fixtures::octahedron(17), export_fixtures::open_octahedron(9)}) {
    const EngineMesh before = engine_mesh(image, 0, layout_for(image), 0);
    EngineMesh after = before;
    order_for_gpu(after);
    EXPECT_EQ(triangles_of(after), triangles_of(before));
  }
}

TEST(OrderForGpu, NumbersVerticesInTheOrderOfTheirFirstUseAndLeavesNoneUnused) {
  const GeometryImage image = export_fixtures::open_octahedron(17);
  EngineMesh mesh = engine_mesh(image, 0, layout_for(image), 0);
  order_for_gpu(mesh);
  std::uint32_t next = 0;
  for (const std::uint32_t index : mesh.indices) {
    ASSERT_LE(index, next);
    next = std::max(next, index + 1);
  }
  EXPECT_EQ(next, mesh.positions.size());
}

TEST(OrderForGpu, MissesTheVertexCacheLessOften) {
  const GeometryImage image = export_fixtures::octahedron(65);
  EngineMesh mesh = engine_mesh(image, 0, layout_for(image), 0);
  const float before = cache_misses_per_triangle(mesh);
  order_for_gpu(mesh);
  EXPECT_LT(cache_misses_per_triangle(mesh), before);
}

TEST(EngineMesh, KeepsTheFramesOfTheBakedLevelOnlyWhereItIsFiner) {
  const GeometryImage image = export_fixtures::octahedron(17);
  const MapLayout layout = layout_for(image);
  const EngineMesh own = engine_mesh(image, 2, layout, 2);
  EXPECT_EQ(engine_mesh(image, 2, layout, 4).tangents, own.tangents);
  EXPECT_NE(engine_mesh(image, 2, layout, 0).tangents, own.tangents);
}

}  // namespace
}  // namespace lozenge
