#include "formats/patches/source_level.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "formats/patches/mapped_fixtures.h"
#include "formats/patches/patch_place.h"
#include "formats/surface/uv_statistics.h"

namespace lozenge {
namespace {

using Subject = fixtures::MappedSurface;

/// The corners of the octahedron's fixture, as far as its faces stay flat.
SourceMesh flattened(SourceMesh mesh) {
  for (Vec3f& p : mesh.positions) {
    p = p / (std::abs(p.x) + std::abs(p.y) + std::abs(p.z));
  }
  return mesh;
}

std::vector<Subject> subjects() {
  std::vector<Subject> all = fixtures::mapped_surfaces({1, 3, 7, 16}, true);
  for (const int n : {4, 9, 16}) {
    auto [mesh, map] = fixtures::subdivided_sphere(fixtures::octahedron(), n);
    fixtures::jitter(map, 0.3 / n, static_cast<unsigned>(n));
    all.push_back({"flat octahedron moved " + std::to_string(n), flattened(mesh), map});
  }
  return all;
}

/// Every subject over atlases of patches of a few texels and of many, with gutters and without.
class SourceLevel : public testing::Test {
 protected:
  template <typename Work>
  void for_each_level(const Work& work) {
    for (const Subject& subject : subjects()) {
      const PatchLayout patches = patch_layout(subject.mesh, subject.map, 17);
      for (const auto& [size, gutter] :
           {std::pair{256, 2}, std::pair{1024, 2}, std::pair{1024, 8}, std::pair{512, 0}}) {
        SCOPED_TRACE(subject.name + ", " + std::to_string(size) + " texels, gutters of " + std::to_string(gutter));
        const MapLayout layout = make_map_layout(patches, size, gutter);
        work(subject, layout, source_level(subject.mesh, subject.map, patches, layout));
      }
    }
  }

  static UvSurface over_atlas(const ChartedSurface& surface, const MapLayout& layout) {
    UvSurface made;
    for (const ChartedTriangle& t : surface.triangles) {
      const auto first = static_cast<std::uint32_t>(made.positions.size());
      made.triangles.push_back({first, first + 1, first + 2});
      for (const ChartedCorner& corner : t.corners) {
        made.positions.push_back(surface.positions[corner.vertex]);
        made.uvs.emplace_back(layout.texcoord(t.patch, corner.place.x, corner.place.y));
      }
    }
    return made;
  }
};

TEST_F(SourceLevel, HangsTogetherWhereTheSourceDoesAndHasItsArea) {
  for_each_level([](const Subject& subject, const MapLayout&, const ChartedSurface& surface) {
    std::map<std::array<VertexId, 2>, int> sides;
    double area = 0;
    for (const ChartedTriangle& t : surface.triangles) {
      for (int c = 0; c < 3; ++c) ++sides[{t.corners[c].vertex, t.corners[(c + 1) % 3].vertex}];
      const Vec3d a(surface.positions[t.corners[0].vertex]);
      area += (Vec3d(surface.positions[t.corners[1].vertex]) - a)
                  .cross(Vec3d(surface.positions[t.corners[2].vertex]) - a)
                  .length() /
              2;
    }
    double boundary = 0;
    for (const auto& [side, count] : sides) {
      EXPECT_EQ(count, 1);
      if (sides.count({side[1], side[0]}) > 0) continue;
      boundary += (Vec3d(surface.positions[side[0]]) - Vec3d(surface.positions[side[1]])).length();
    }
    std::map<std::array<VertexId, 2>, int> of_source;
    for (const auto& t : subject.mesh.triangles) {
      for (int c = 0; c < 3; ++c) ++of_source[{t[c], t[(c + 1) % 3]}];
    }
    double due = 0;
    for (const auto& [side, count] : of_source) {
      if (of_source.count({side[1], side[0]}) > 0) continue;
      due += (Vec3d(subject.mesh.positions[side[0]]) - Vec3d(subject.mesh.positions[side[1]])).length();
    }
    // A cut point is rounded to floats, and may lie off its edge by that.
    EXPECT_NEAR(boundary, due, 1e-5);
    EXPECT_NEAR(area, surface_area(subject.mesh.positions, subject.mesh.triangles), 1e-5 * area);
  });
}

TEST_F(SourceLevel, LiesInTheAtlasWithoutFoldsOrOverlapsAndKeepsItsGutters) {
  for_each_level([](const Subject&, const MapLayout& layout, const ChartedSurface& surface) {
    const UvStatistics uvs = uv_statistics(over_atlas(surface, layout), layout.width);
    EXPECT_EQ(uvs.folded, 0);
    EXPECT_EQ(uvs.outside, 0);
    EXPECT_EQ(uvs.overlapping_texels, 0);
    for (const ChartedTriangle& t : surface.triangles) {
      const MapTile tile = layout.tile_of(t.patch);
      const double reach = std::max(0.01, tile.gutter - 0.5) / (tile.inner() - 1);
      for (const ChartedCorner& corner : t.corners) {
        const Vec2d& p = corner.place;
        // A filter that looks at the texels around finds those of the gutter, and no further ones.
        EXPECT_GE(std::min({p.x, p.y, 1 - p.x, 1 - p.y}), -reach - 1e-8);
      }
    }
  });
}

TEST_F(SourceLevel, HasUnitNormalsThatAgreeOnBorders) {
  for_each_level([](const Subject&, const MapLayout&, const ChartedSurface& surface) {
    std::map<VertexId, Vec3f> normals;  // the source has none of its own: they are its vertices'
    for (const ChartedTriangle& t : surface.triangles) {
      for (const ChartedCorner& corner : t.corners) {
        EXPECT_NEAR(corner.carried.length(), 1, 1e-6);
        EXPECT_EQ(normals.try_emplace(corner.vertex, corner.carried).first->second, corner.carried);
      }
    }
  });
}

TEST(SourceLevelOfFlatFaces, LeavesOutEveryVertexThatNeitherShapeNorAtlasNeeds) {
  const auto sphere = fixtures::subdivided_sphere(fixtures::octahedron(), 16);
  SourceMesh mesh = flattened(sphere.first);
  const Parameterization& map = sphere.second;
  // Linear on each face, as the map is, so that nothing moves in the atlas.
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const DomainPoint& p = map.phi[v];
    const auto corner = [&](int c) {
      const DomainVertex at = map.domain.corner(p.triangle, c);
      for (std::size_t u = 0; u < mesh.positions.size(); ++u) {
        if (vertex_at(map.domain, map.phi[u]) == at) return Vec3d(mesh.positions[u]);
      }
      return Vec3d(0, 0, 0);
    };
    mesh.positions[v] = Vec3f(corner(0) * p.alpha + corner(1) * p.beta + corner(2) * p.gamma());
  }
  mesh.corner_attributes.clear();
  AttributeStream& normals = stream_for(mesh.corner_attributes, kNormals);
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec3f middle = (mesh.positions[a] + mesh.positions[b] + mesh.positions[c]) / 3;
    const Vec3f n =
        Vec3f(std::copysign(1.0F, middle.x), std::copysign(1.0F, middle.y), std::copysign(1.0F, middle.z)).normalized();
    for (int k = 0; k < 3; ++k) normals.values.insert(normals.values.end(), {n.x, n.y, n.z});
  }
  const PatchLayout patches = patch_layout(mesh, map, 17);
  const ChartedSurface surface = source_level(mesh, map, patches, make_map_layout(patches, 1024, 2));
  // Of each face, three triangles around its barycentre.
  EXPECT_EQ(surface.triangles.size(), 24U);
}

/// A box over the tetrahedron: four of its corners are the domain's vertices, the others lie in the barycentres, as
/// near as the lattice comes to a third.
Subject box_over_tetrahedron() {
  Subject box{"box", {}, {fixtures::tetrahedron(), {}}};
  const Domain& domain = box.map.domain;
  const std::array<Vec3f, 4> places{Vec3f(1, 1, 1), Vec3f(1, -1, -1), Vec3f(-1, 1, -1), Vec3f(-1, -1, 1)};
  std::array<VertexId, 4> corners{};
  for (const DomainCorner& corner : corner_of_each_vertex(domain)) {
    const DomainVertex v = domain.corner(corner.triangle, corner.corner);
    corners[v] = static_cast<VertexId>(box.mesh.positions.size());
    box.mesh.positions.push_back(places[v]);
    box.map.phi.push_back(corner_point(corner));
  }
  for (DomainTriangleId t = 0; t < domain.size(); ++t) {
    const auto middle = static_cast<VertexId>(box.mesh.positions.size());
    Vec3f sum(0, 0, 0);
    for (int c = 0; c < 3; ++c) sum += places[domain.corner(t, c)];
    box.mesh.positions.push_back(sum);  // the corner of the box between those three
    box.map.phi.push_back(make_point(t, 1.0 / 3, 1.0 / 3));
    for (int c = 0; c < 3; ++c) {
      box.mesh.triangles.push_back({middle, corners[domain.corner(t, c)], corners[domain.corner(t, (c + 1) % 3)]});
    }
  }
  return box;
}

TEST(SourceLevelOfABox, HasItsTwelveTriangles) {
  const Subject box = box_over_tetrahedron();
  const PatchLayout patches = patch_layout(box.mesh, box.map, 2);
  const CutSurface cut = cut_along_patches(box.mesh, box.map, patches.places);
  EXPECT_EQ(cut.triangles.size(), 12U);
  EXPECT_EQ(cut.cut, 0);
  for (const int size : {64, 2048}) {
    const ChartedSurface surface = source_level(box.mesh, box.map, patches, make_map_layout(patches, size, 2));
    EXPECT_EQ(surface.triangles.size(), 12U);
  }
}

}  // namespace
}  // namespace lozenge
