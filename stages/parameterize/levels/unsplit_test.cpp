#include "stages/parameterize/levels/unsplit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>

#include "formats/domain/distortion.h"
#include "formats/domain/sphere_fixtures.h"
#include "formats/surface/attribute_fixtures.h"
#include "formats/surface/canonical_form.h"
#include "stages/parameterize/certify.h"
#include "stages/parameterize/levels/split_long_edges.h"
#include "stages/parameterize/surface_fixtures.h"

namespace lozenge {
namespace {

constexpr double kAnything = 1e9;

/// A triangle by where its corners are, from the lowest on.
using Places = std::array<std::array<float, 3>, 3>;
std::multiset<Places> triangles_by_place(const SourceMesh& mesh) {
  std::multiset<Places> all;
  for (const auto& t : mesh.triangles) {
    Places places;
    for (int c = 0; c < 3; ++c) places[c] = {mesh.positions[t[c]].x, mesh.positions[t[c]].y, mesh.positions[t[c]].z};
    std::rotate(places.begin(), std::min_element(places.begin(), places.end()), places.end());
    all.insert(places);
  }
  return all;
}

struct Split {
  SourceMesh mesh;
  Parameterization map;
  std::vector<char> may_go;
};

/// The octahedron's own triangles, as many on each face, split until none is longer than `longest`; each piece is
/// mapped to where it lies on its face.
Split split_octahedron(int n, double longest, SourceMesh& source) {
  const std::vector<Vec3d> corners{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  auto [mesh, map] = fixtures::subdivided(fixtures::octahedron(), n, corners, [n](const Vec3d& p) { return p / n; });
  fixtures::plant_attributes(mesh);
  source = mesh;
  Split split;
  std::vector<VertexId> number;
  number_triangles(mesh);
  split.mesh = split_long_edges(mesh, longest, 1 << 20, &number);
  split.map.domain = map.domain;
  split.may_go.assign(split.mesh.positions.size(), 1);
  for (std::size_t v = 0; v < source.positions.size(); ++v) split.may_go[number[v]] = 0;
  // Of a point of a face, |x|, |y| and |z| are its barycentric coordinates.
  for (const Vec3f& p : split.mesh.positions) {
    DomainPoint found;
    for (DomainTriangleId t = 0; t < map.domain.size() && found.triangle < 0; ++t) {
      std::array<double, 3> weights{};
      bool inside = true;
      for (int c = 0; c < 3; ++c) {
        weights[c] = Vec3d(p).dot(corners[map.domain.corner(t, c)]);
        inside = inside && weights[c] >= 0;
      }
      if (inside) found = make_point(t, weights[0], weights[1]);
    }
    split.map.phi.push_back(found);
  }
  return split;
}

TEST(Unsplit, MakesTheSourceWholeAgainWhereTheMapLetsIt) {
  for (const int n : {1, 2, 4}) {
    SourceMesh source;
    Split split = split_octahedron(n, 0.21, source);
    ASSERT_GT(split.mesh.triangles.size(), source.triangles.size());
    ASSERT_EQ(measure_distortion(split.mesh, split.map).folded_triangles, 0);
    EXPECT_GT(take_out_splits(split.mesh, split.map, split.may_go, kAnything), 0);
    forget_numbers(split.mesh);
    make_canonical_with_map(split.mesh, split.map);
    EXPECT_EQ(triangles_by_place(split.mesh), triangles_by_place(source)) << n;
    fixtures::expect_planted_attributes(split.mesh);
    const Distortion d = measure_distortion(split.mesh, split.map);
    EXPECT_EQ(d.folded_triangles, 0);
    EXPECT_EQ(d.area_sum_error, 0);
  }
}

TEST(Unsplit, TakesNothingOutThatWouldCostTooMuch) {
  SourceMesh source;
  Split split = split_octahedron(2, 0.21, source);
  const std::size_t before = split.mesh.triangles.size();
  EXPECT_EQ(take_out_splits(split.mesh, split.map, split.may_go, -1), 0);
  EXPECT_EQ(split.mesh.triangles.size(), before);
}

TEST(Unsplit, LeavesConesTheirVertices) {
  // Split vertices on the octahedron's corners can't be had; the source's own vertices there stay, and so does anything
  // that may not go.
  SourceMesh source;
  Split split = split_octahedron(2, 0.21, source);
  std::fill(split.may_go.begin(), split.may_go.end(), 1);
  take_out_splits(split.mesh, split.map, split.may_go, kAnything);
  make_canonical_with_map(split.mesh, split.map);
  const Distortion d = measure_distortion(split.mesh, split.map);
  EXPECT_EQ(d.folded_triangles, 0);
  EXPECT_EQ(d.area_sum_error, 0);
  std::set<DomainVertex> held;
  for (const DomainPoint& p : split.map.phi) held.insert(vertex_at(split.map.domain, p));
  held.erase(-1);
  EXPECT_EQ(held.size(), 6U);
}

TEST(Unsplit, DoesNothingToAMeshWithoutNumbers) {
  SourceMesh source;
  Split split = split_octahedron(1, 0.3, source);
  forget_numbers(split.mesh);
  EXPECT_EQ(take_out_splits(split.mesh, split.map, split.may_go, kAnything), 0);
}

}  // namespace
}  // namespace lozenge
