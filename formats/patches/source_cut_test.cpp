#include "formats/patches/source_cut.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "formats/patches/mapped_fixtures.h"
#include "formats/patches/patch_place.h"

namespace lozenge {
namespace {

using Subject = fixtures::MappedSurface;

/// From source triangles as large as the domain's to many for each of them.
std::vector<Subject> subjects() {
  std::vector<Subject> all = fixtures::mapped_surfaces({1, 2, 3, 7, 16}, true);
  // Vertices that were at barycentres, and are next to them now: by whole sides down to steps of the lattice.
  for (int bits = 12; bits <= 39; ++bits) {
    auto [mesh, map] = fixtures::subdivided_sphere(fixtures::octahedron(), 3);
    fixtures::jitter(map, std::ldexp(1.0, -bits), static_cast<unsigned>(bits));
    all.push_back({"barycentres moved by 2^-" + std::to_string(bits), mesh, map});
  }
  return all;
}

using Side = std::array<VertexId, 2>;

template <typename Triangles, typename CornerOf>
std::map<Side, int> sides_of(const Triangles& triangles, const CornerOf& corner) {
  std::map<Side, int> sides;
  for (const auto& t : triangles) {
    for (int c = 0; c < 3; ++c) ++sides[{corner(t, c), corner(t, (c + 1) % 3)}];
  }
  return sides;
}

/// What every cut surface must be, whatever the source.
class SourceCut : public testing::Test {
 protected:
  template <typename Work>
  void for_each_cut(const Work& work) {
    for (const Subject& subject : subjects()) {
      SCOPED_TRACE(subject.name);
      const auto places = patch_places(subject.map.domain);
      work(subject, places, cut_along_patches(subject.mesh, subject.map, places));
    }
  }
};

TEST_F(SourceCut, HasEachSideOnceAndItsReverseWhereTheSourceHasIt) {
  for_each_cut([](const Subject& subject, const auto&, const CutSurface& cut) {
    const auto sides = sides_of(cut.triangles, [](const CutTriangle& t, int c) { return t.corners[c].vertex; });
    const auto source = sides_of(subject.mesh.triangles, [](const auto& t, int c) { return t[c]; });
    const auto vertices = static_cast<VertexId>(subject.mesh.positions.size());
    for (const auto& [side, count] : sides) {
      EXPECT_EQ(count, 1);
      if (sides.count({side[1], side[0]}) > 0) continue;
      // An end of the surface: a part of an edge of the source that is one.
      Side edge = side;
      for (VertexId& v : edge) {
        if (v < vertices) continue;
        const CutPoint& point = cut.points[v - vertices];
        ASSERT_GE(point.ends[0], 0) << "the surface ends inside of a triangle";
        edge = point.ends;
        break;
      }
      EXPECT_FALSE(source.count(edge) > 0 && source.count({edge[1], edge[0]}) > 0);
    }
  });
}

TEST_F(SourceCut, FillsEachSourceTriangleOnceAndTurnsNone) {
  for_each_cut([](const Subject& subject, const auto&, const CutSurface& cut) {
    std::vector<double> filled(subject.mesh.triangles.size(), 0);
    for (const CutTriangle& t : cut.triangles) {
      const Vec3d a = t.corners[0].weights;
      const Vec3d area = (t.corners[1].weights - a).cross(t.corners[2].weights - a);
      EXPECT_GT(area.x + area.y + area.z, -1e-12);
      filled[t.source] += (area.x + area.y + area.z) / 3;
    }
    for (const double share : filled) EXPECT_NEAR(share, 1, 1e-9);
  });
}

TEST_F(SourceCut, PutsEachCornerWhereItsPatchHasIt) {
  for_each_cut([](const Subject& subject, const auto& places, const CutSurface& cut) {
    const auto vertices = static_cast<VertexId>(subject.mesh.positions.size());
    for (const CutTriangle& t : cut.triangles) {
      for (const CutCorner& corner : t.corners) {
        // Texture coordinates may lie a hair beyond the border; there is a gutter.
        const Vec2d& p = corner.place;
        ASSERT_GE(std::min({p.x, p.y, 1 - p.x, 1 - p.y}), -1e-6);
        EXPECT_TRUE(places[t.patch].right.exists() || p.y >= p.x - 1e-6);
        if (corner.vertex >= vertices) continue;
        const DomainPoint there =
            domain_point_at(places[t.patch], std::clamp(p.x, 0.0, 1.0), std::clamp(p.y, 0.0, 1.0));
        const DomainPoint here = subject.map.phi[corner.vertex];
        if (here.triangle != there.triangle) continue;  // a side or a corner has several names
        EXPECT_NEAR(there.alpha, here.alpha, 1e-6);
        EXPECT_NEAR(there.beta, here.beta, 1e-6);
      }
    }
  });
}

TEST_F(SourceCut, GivesACornerOfOnePatchTheSameBitsInAllItsTriangles) {
  for_each_cut([](const Subject&, const auto&, const CutSurface& cut) {
    // Around a cone of few triangles an image may reach the same patch from two sides.
    std::map<std::pair<std::int32_t, VertexId>, std::vector<Vec2d>> places;
    for (const CutTriangle& t : cut.triangles) {
      for (const CutCorner& corner : t.corners) {
        std::vector<Vec2d>& known = places[{t.patch, corner.vertex}];
        const auto near = [&](const Vec2d& p) { return (p - corner.place).length() < 1e-6; };
        const auto found = std::find_if(known.begin(), known.end(), near);
        if (found == known.end()) {
          known.push_back(corner.place);
          continue;
        }
        EXPECT_EQ(*found, corner.place);
      }
    }
  });
}

TEST_F(SourceCut, LeavesTrianglesInsideOfAPatchAsTheyAre) {
  auto [mesh, map] = fixtures::subdivided_sphere(fixtures::icosahedron(), 30);
  const CutSurface cut = cut_along_patches(mesh, map, patch_places(map.domain));
  // Three borders of at most 60 triangles each in 20 domain triangles.
  EXPECT_LT(cut.cut, 20 * 3 * 60);
  EXPECT_GT(cut.cut, 0);
  EXPECT_LT(cut.triangles.size(), 2 * mesh.triangles.size());
}

}  // namespace
}  // namespace lozenge
