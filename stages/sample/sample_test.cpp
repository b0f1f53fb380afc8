#include "stages/sample/sample.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "formats/base/error.h"
#include "formats/domain/open_fixtures.h"
#include "formats/domain/sphere_fixtures.h"
#include "formats/patches/level_mesh.h"
#include "formats/patches/patch_neighbours.h"
#include "formats/surface/mesh_statistics.h"
#include "stages/sample/distinct.h"

namespace lozenge {
namespace {

struct Case {
  SourceMesh mesh;
  Parameterization map;
  std::int32_t samples;
};

std::vector<Case> cases() {
  std::vector<Case> found;
  for (const Domain& base : {fixtures::tetrahedron(), fixtures::octahedron(), fixtures::icosahedron()}) {
    for (const int n : {1, 4, 11}) {
      for (const std::int32_t samples : {2, 3, 5, 17}) {
        auto [mesh, map] = fixtures::subdivided_sphere(base, n);
        fixtures::jitter(map, 0.2 / n, static_cast<unsigned>(n));
        found.push_back({mesh, map, samples});
      }
    }
  }
  return found;
}

template <typename T>
bool same_bits(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}
bool same_bits(const PatchSet& a, const PatchSet& b) {
  return same_bits(a.positions, b.positions) && same_bits(a.normals, b.normals) &&
         same_bits(a.source_triangles, b.source_triangles) && same_bits(a.source_weights, b.source_weights);
}

TEST(Sample, MarksWhatLiesOnCaps) {
  auto [mesh, map] = fixtures::subdivided_sphere(fixtures::octahedron(), 8);
  const PatchSet plain = sample(mesh, map, {17});
  EXPECT_TRUE(plain.caps.empty());
  // The sphere's top is the cap of a hole; then the same without anything on it.
  mesh.material_names = {"stone", "cap of stone"};
  mesh.cap_of = {-1, 0};
  for (const auto& triangle : mesh.triangles) mesh.materials.push_back(mesh.positions[triangle[0]].z > 0.9F ? 1 : 0);
  const PatchSet capped = sample(mesh, map, {17});
  ASSERT_EQ(capped.caps.size(), capped.positions.size());
  for (std::size_t s = 0; s < capped.caps.size(); ++s) {
    EXPECT_EQ(capped.caps[s], is_cap(mesh, capped.source_triangles[s]) ? 1U : 0U);
  }
  EXPECT_GT(std::count(capped.caps.begin(), capped.caps.end(), 1U), 0);
  mesh.materials.assign(mesh.triangles.size(), 0);
  EXPECT_TRUE(sample(mesh, map, {17}).caps.empty());
}

TEST(Sample, SaysWhetherAnyTriangleIsToBeSeenFromBothSides) {
  auto [mesh, map] = fixtures::subdivided_sphere(fixtures::octahedron(), 2);
  EXPECT_FALSE(sample(mesh, map, {2}).layout.double_sided);
  mesh.material_names = {"stone", "leaf"};
  mesh.double_sided = {false, true};
  mesh.materials.assign(mesh.triangles.size(), 0);
  EXPECT_FALSE(sample(mesh, map, {2}).layout.double_sided);
  mesh.materials.back() = 1;
  EXPECT_TRUE(sample(mesh, map, {2}).layout.double_sided);
}

TEST(Sample, SaysOfEachPatchToWhichBodyItBelongs) {
  // Half a sphere, and a whole one beside it.
  const fixtures::OpenSurface two = fixtures::open_and_closed(4);
  SourceMesh mesh = two.mesh;
  EXPECT_TRUE(sample(mesh, two.map, {5}).layout.bodies.empty());
  const auto is_closed = [&](DomainTriangleId t) { return t >= 4; };
  mesh.material_names = {"stone", "bead"};
  for (const auto& triangle : mesh.triangles) mesh.materials.push_back(is_closed(two.map.phi[triangle[0]].triangle));
  mesh.bodies = {{{"bead", {{}}, -1}}, {-1, 0}};
  const PatchSet set = sample(mesh, two.map, {5});
  ASSERT_EQ(set.layout.bodies.owner.size(), set.layout.places.size());
  for (std::size_t p = 0; p < set.layout.places.size(); ++p) {
    EXPECT_EQ(set.layout.bodies.owner[p], is_closed(set.layout.places[p].left.triangle) ? 0 : -1);
  }
  EXPECT_FALSE(find_defect(set.layout.bodies, set.layout.places.size()));
}

TEST(Sample, GivesBothPatchesTheSameBitsOnTheirBorder) {
  for (const Case& c : cases()) {
    const PatchSet set = sample(c.mesh, c.map, {c.samples});
    const PatchNeighbours neighbours(set.layout.samples, set.layout.adjacency);
    for (std::int32_t p = 0; p < set.size(); ++p) {
      for (std::int32_t k = 0; k < c.samples; ++k) {
        for (int side = 0; side < 4; ++side) {
          const PatchSample here = neighbours.on_side({p, side}, k);
          for (const PatchSample& name : neighbours.names(here)) {
            const std::size_t a = set.index(here.patch, here.i, here.j);
            const std::size_t b = set.index(name.patch, name.i, name.j);
            EXPECT_EQ(std::memcmp(&set.positions[a], &set.positions[b], sizeof(Vec3f)), 0);
            EXPECT_EQ(std::memcmp(&set.normals[a], &set.normals[b], sizeof(Vec3f)), 0);
            EXPECT_EQ(set.source_triangles[a], set.source_triangles[b]);
            EXPECT_EQ(set.source_weights[a], set.source_weights[b]);
          }
        }
      }
    }
  }
}

TEST(Sample, LiesOnItsSourceTriangleWithTheWeightsThatItNames) {
  for (const Case& c : cases()) {
    const PatchSet set = sample(c.mesh, c.map, {c.samples});
    for (std::size_t s = 0; s < set.positions.size(); ++s) {
      const auto& corners = c.mesh.triangles.at(static_cast<std::size_t>(set.source_triangles[s]));
      Vec3f sum(0, 0, 0);
      for (int k = 0; k < 3; ++k) {
        EXPECT_GE(set.source_weights[s][k], 0);
        sum += c.mesh.positions[corners[k]] * set.source_weights[s][k];
      }
      EXPECT_LT((sum - set.positions[s]).length(), 1e-6F);
      EXPECT_NEAR(set.normals[s].length(), 1, 1e-6);
    }
  }
}

TEST(Sample, WeldsIntoAClosedSurfaceWhoseIrregularVerticesAreTheDomains) {
  for (const Case& c : cases()) {
    const LevelMesh mesh = patch_mesh(sample(c.mesh, c.map, {c.samples}));
    const MeshStatistics facts = mesh_statistics(mesh.view());
    EXPECT_TRUE(is_closed_manifold(facts));
    EXPECT_EQ(facts.euler, 2);
    // Six patches around a vertex of six: the fixtures' vertices all have fewer.
    EXPECT_EQ(static_cast<std::int32_t>(irregular_vertices(mesh).size()), count_irregular(c.map.domain));
    std::vector<Vec3f> corners;
    for (const DomainCorner corner : corner_of_each_vertex(c.map.domain)) {
      for (std::size_t v = 0; v < c.map.phi.size(); ++v) {
        if (vertex_at(c.map.domain, c.map.phi[v]) == c.map.domain.corner(corner.triangle, corner.corner)) {
          corners.push_back(c.mesh.positions[v]);
        }
      }
    }
    for (const std::int32_t v : irregular_vertices(mesh)) {
      EXPECT_NE(std::find(corners.begin(), corners.end(), mesh.positions[v]), corners.end());
    }
  }
}

TEST(Sample, IsTheSameOnAnyNumberOfThreads) {
  for (const Case& c : cases()) {
    const PatchSet many = sample(c.mesh, c.map, {c.samples});
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    EXPECT_TRUE(same_bits(many, sample(c.mesh, c.map, {c.samples})));
  }
}

TEST(Sample, CoarserGridsAreEverySecondSample) {
  auto [mesh, map] = fixtures::subdivided_sphere(fixtures::icosahedron(), 7);
  fixtures::jitter(map, 0.02, 1);
  const PatchSet fine = sample(mesh, map, {17});
  const PatchSet coarse = sample(mesh, map, {9});
  for (std::int32_t p = 0; p < fine.size(); ++p) {
    for (std::int32_t j = 0; j < 9; ++j) {
      for (std::int32_t i = 0; i < 9; ++i) {
        EXPECT_EQ(fine.positions[fine.index(p, 2 * i, 2 * j)], coarse.positions[coarse.index(p, i, j)]);
      }
    }
  }
}

TEST(Sample, NeverHoldsMinusZero) {
  for (const Case& c : cases()) {
    const PatchSet set = sample(c.mesh, c.map, {c.samples});
    for (const auto* values : {&set.positions, &set.normals}) {
      for (const Vec3f& v : *values) {
        for (int k = 0; k < 3; ++k) EXPECT_FALSE(v[k] == 0 && std::signbit(v[k]));
      }
    }
  }
}

TEST(Sample, RefusesNumbersThatAreNotAPowerOfTwoPlusOne) {
  const auto [mesh, map] = fixtures::subdivided_sphere(fixtures::tetrahedron(), 2);
  for (const std::int32_t samples : {INT32_MIN, -17, -1, 1, 4, 6, 7, 16, 18, 1024, 2049, INT32_MAX}) {
    try {
      sample(mesh, map, {samples});
      FAIL() << samples << " samples were taken";
    } catch (const Error& e) {
      EXPECT_EQ(e.code(), ExitCode::kUsage);
    }
  }
}

TEST(MakeDistinct, LeavesNothingToDoOnAFineGridOfFloats) {
  auto [mesh, map] = fixtures::subdivided_sphere(fixtures::icosahedron(), 6);
  PatchSet set = sample(mesh, map, {33});
  EXPECT_EQ(make_distinct(set), 0);
}

TEST(MakeDistinct, KeepsTheMeshClosedWhereFloatsAreCoarserThanTheGrid) {
  for (const Domain& base : {fixtures::tetrahedron(), fixtures::icosahedron()}) {
    auto [mesh, map] = fixtures::subdivided_sphere(base, 3);
    // At 2^20 a float is 1/8 wide; at 2^30 all of the sphere is one float.
    for (const float far : {1048576.0F, 1073741824.0F}) {
      SourceMesh moved = mesh;
      for (Vec3f& p : moved.positions) p += Vec3f(far, -far, far);
      const PatchSet set = sample(moved, map, {17});
      const LevelMesh welded = patch_mesh(set);
      EXPECT_TRUE(is_closed_manifold(mesh_statistics(welded.view())));
      EXPECT_EQ(mesh_statistics(welded.view()).euler, 2);
    }
  }
}

}  // namespace
}  // namespace lozenge
