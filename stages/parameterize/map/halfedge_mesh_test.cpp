// The connectivity of meshes, and the way back from `simplify`, which changes it in place.
#include "stages/parameterize/map/halfedge_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "stages/parameterize/levels/simplify.h"
#include "stages/parameterize/surface_fixtures.h"

namespace lozenge {
namespace {

using Triangles = std::vector<std::array<VertexId, 3>>;

/// Triangles in another order, each beginning with another corner.
void shuffle(Triangles& triangles, std::mt19937& random) {
  std::shuffle(triangles.begin(), triangles.end(), random);
  for (auto& t : triangles) std::rotate(t.begin(), t.begin() + random() % 3, t.end());
}

HalfedgeMesh halfedges_of(const SourceMesh& mesh) {
  return make_halfedge_mesh(mesh.triangles, static_cast<std::int32_t>(mesh.positions.size()));
}

double random_height(unsigned seed) { return 0.05 * (seed % 5); }

SourceMesh random_sphere(int n, unsigned seed) {
  return test::sphere(n, test::random_relief(random_height(seed), seed));
}

SourceMesh random_torus(int around, int along, unsigned seed) {
  const auto relief = test::random_relief(random_height(seed), seed);
  return test::torus(around, along, 0.4, [relief](double u, double v) {
    return 0.4 * relief(Vec3d(std::cos(u), std::sin(u), std::cos(v)));
  });
}

/// Closed surfaces of genus 0, 1, and of two components.
std::vector<SourceMesh> closed_surfaces(unsigned seed) {
  std::mt19937 random(seed);
  const int n = 3 + static_cast<int>(random() % 8);
  std::vector<SourceMesh> surfaces{random_sphere(n, seed), random_torus(5 + n, 4 + n, seed)};
  surfaces.push_back(test::beside(surfaces[0], surfaces[1], 5));
  for (SourceMesh& mesh : surfaces) shuffle(mesh.triangles, random);
  return surfaces;
}

/// A square grid with boundary, its diagonals random.
SourceMesh random_patch(unsigned seed) {
  std::mt19937 random(seed);
  const int width = 1 + static_cast<int>(random() % 7), height = 1 + static_cast<int>(random() % 7);
  SourceMesh mesh;
  for (int j = 0; j <= height; ++j) {
    for (int i = 0; i <= width; ++i) mesh.positions.emplace_back(static_cast<float>(i), static_cast<float>(j), 0.0F);
  }
  for (int j = 0; j < height; ++j) {
    for (int i = 0; i < width; ++i) {
      const VertexId a = j * (width + 1) + i, b = a + 1, c = a + width + 1, d = c + 1;
      if (random() % 2 == 0) mesh.triangles.insert(mesh.triangles.end(), {{a, b, d}, {a, d, c}});
      else mesh.triangles.insert(mesh.triangles.end(), {{a, b, c}, {b, d, c}});
    }
  }
  shuffle(mesh.triangles, random);
  return mesh;
}

/// Takes triangles out that have no vertex in common, so that what is left is a manifold with holes.
void punch_holes(SourceMesh& mesh) {
  std::set<VertexId> used;
  Triangles left;
  for (const auto& t : mesh.triangles) {
    if (used.count(t[0]) + used.count(t[1]) + used.count(t[2]) > 0) left.push_back(t);
    else used.insert(t.begin(), t.end());
  }
  mesh.triangles = left;
}

std::vector<SourceMesh> open_surfaces(unsigned seed) {
  std::vector<SourceMesh> surfaces = closed_surfaces(seed);
  // Half a small mesh's vertices may go; none may lose all its triangles.
  for (SourceMesh& mesh : surfaces) punch_holes(mesh);
  surfaces.push_back(random_patch(seed));
  return surfaces;
}

/// By counting: vertices - edges + triangles of what isn't removed.
int euler_characteristic(const HalfedgeMesh& mesh) {
  std::set<VertexId> vertices;
  std::set<std::pair<VertexId, VertexId>> edges;
  int triangles = 0;
  for (TriangleId t = 0; t < mesh.triangle_count(); ++t) {
    if (mesh.removed(t)) continue;
    ++triangles;
    for (Halfedge h = 3 * t; h < 3 * t + 3; ++h) {
      vertices.insert(mesh.start(h));
      edges.insert(std::minmax(mesh.start(h), mesh.end(h)));
    }
  }
  return static_cast<int>(vertices.size()) - static_cast<int>(edges.size()) + triangles;
}

void expect_twins_are_sound(const HalfedgeMesh& mesh) {
  for (Halfedge h = 0; h < static_cast<Halfedge>(mesh.twins.size()); ++h) {
    const Halfedge g = mesh.twins[h];
    if (mesh.removed(h / 3) || g < 0) continue;
    ASSERT_FALSE(mesh.removed(g / 3));
    ASSERT_NE(g, h);
    ASSERT_EQ(mesh.twins[g], h);
    ASSERT_EQ(mesh.start(g), mesh.end(h));
    ASSERT_EQ(mesh.end(g), mesh.start(h));
  }
}

void expect_visits_go_once_around(const HalfedgeMesh& mesh) {
  std::vector<int> visits(mesh.twins.size(), 0);
  for (VertexId v = 0; v < mesh.vertex_count(); ++v) {
    if (mesh.outgoing[v] < 0) continue;
    Halfedge last = -1, first = -1;
    for_each_outgoing(mesh, v, [&](Halfedge h) {
      EXPECT_EQ(mesh.start(h), v);
      // Counter-clockwise: a triangle lies on the left of each of its half-edges, so the next one leads to the corner
      // that the last triangle has there.
      if (last >= 0) {
        EXPECT_EQ(mesh.end(h), mesh.opposite(last));
      }
      if (first < 0) first = h;
      last = h;
      ++visits[h];
    });
    const bool open = mesh.twins[previous_in_triangle(last)] < 0;
    if (open) {
      EXPECT_LT(mesh.twins[first], 0);
    } else {
      EXPECT_EQ(mesh.end(first), mesh.opposite(last));
    }
  }
  for (Halfedge h = 0; h < static_cast<Halfedge>(visits.size()); ++h) {
    ASSERT_EQ(visits[h], mesh.removed(h / 3) ? 0 : 1);
  }
}

/// Every edge has two sides, no two edges join the same vertices, and every vertex has one fan of three or more.
void expect_closed_manifold(const HalfedgeMesh& mesh) {
  expect_twins_are_sound(mesh);
  expect_visits_go_once_around(mesh);
  std::set<std::pair<VertexId, VertexId>> sides;
  for (Halfedge h = 0; h < static_cast<Halfedge>(mesh.twins.size()); ++h) {
    if (mesh.removed(h / 3)) continue;
    ASSERT_GE(mesh.twins[h], 0);
    ASSERT_TRUE(sides.emplace(mesh.start(h), mesh.end(h)).second);
  }
  for (VertexId v = 0; v < mesh.vertex_count(); ++v) {
    if (mesh.outgoing[v] < 0) continue;
    int degree = 0;
    for_each_outgoing(mesh, v, [&](Halfedge) { ++degree; });
    ASSERT_GE(degree, 3);
  }
}

std::int32_t triangles_left(const HalfedgeMesh& mesh) {
  std::int32_t left = 0;
  for (TriangleId t = 0; t < mesh.triangle_count(); ++t) left += !mesh.removed(t);
  return left;
}

TEST(HalfedgeMeshes, OfClosedSurfacesHaveReciprocalOppositeTwinsEverywhere) {
  for (unsigned seed = 0; seed < 30; ++seed) {
    for (const SourceMesh& mesh : closed_surfaces(seed)) expect_closed_manifold(halfedges_of(mesh));
  }
}

TEST(HalfedgeMeshes, OfOpenSurfacesHaveNoTwinAtTheBoundaryAndOnlyThere) {
  for (unsigned seed = 0; seed < 30; ++seed) {
    for (const SourceMesh& surface : open_surfaces(seed)) {
      const HalfedgeMesh mesh = halfedges_of(surface);
      expect_twins_are_sound(mesh);
      std::set<std::pair<VertexId, VertexId>> sides;
      for (Halfedge h = 0; h < static_cast<Halfedge>(mesh.twins.size()); ++h) sides.emplace(mesh.start(h), mesh.end(h));
      int boundary = 0;
      for (Halfedge h = 0; h < static_cast<Halfedge>(mesh.twins.size()); ++h) {
        EXPECT_EQ(mesh.twins[h] < 0, !sides.count({mesh.end(h), mesh.start(h)}));
        boundary += mesh.twins[h] < 0;
      }
      EXPECT_GT(boundary, 0);
    }
  }
}

TEST(HalfedgeMeshes, VisitEachHalfedgeOfAVertexOnceCounterClockwise) {
  for (unsigned seed = 0; seed < 30; ++seed) {
    for (const SourceMesh& mesh : closed_surfaces(seed)) expect_visits_go_once_around(halfedges_of(mesh));
    for (const SourceMesh& mesh : open_surfaces(seed)) expect_visits_go_once_around(halfedges_of(mesh));
  }
}

TEST(HalfedgeMeshes, TurnCounterClockwiseSeenFromOutside) {
  for (int n = 1; n < 8; ++n) {
    const SourceMesh surface = random_sphere(n, 0);  // without relief
    const HalfedgeMesh mesh = halfedges_of(surface);
    for (VertexId v = 0; v < mesh.vertex_count(); ++v) {
      const Vec3f p = surface.positions[v];
      for_each_outgoing(mesh, v, [&](Halfedge h) {
        const Vec3f to = surface.positions[mesh.end(h)];
        const Vec3f next = surface.positions[mesh.end(mesh.next_around(h))];
        EXPECT_GT((to - p).cross(next - p).dot(p), 0);
      });
    }
  }
}

TEST(HalfedgeMeshes, HaveNoHalfedgeForAVertexThatNoTriangleUses) {
  const HalfedgeMesh mesh = make_halfedge_mesh({{1, 3, 4}}, 6);
  for (const VertexId v : {0, 2, 5}) EXPECT_EQ(mesh.outgoing[v], -1);
  for (const VertexId v : {1, 3, 4}) EXPECT_EQ(mesh.start(mesh.outgoing[v]), v);
}

TEST(Simplify, LeavesAClosedManifoldOfTheSameEulerCharacteristic) {
  for (unsigned seed = 0; seed < 30; ++seed) {
    for (const SourceMesh& surface : closed_surfaces(seed)) {
      const HalfedgeMesh before = halfedges_of(surface);
      HalfedgeMesh mesh = before;
      const std::int32_t target = before.triangle_count() / 2;
      const auto removals = simplify(mesh, surface.positions, target);
      expect_closed_manifold(mesh);
      EXPECT_EQ(euler_characteristic(mesh), euler_characteristic(before));
      EXPECT_FALSE(removals.empty());
      EXPECT_EQ(triangles_left(mesh), before.triangle_count() - 2 * static_cast<std::int32_t>(removals.size()));
      EXPECT_GE(triangles_left(mesh), target - 1);
    }
  }
}

TEST(Simplify, KeepsTheTopologyWhenAskedForNoTrianglesAtAll) {
  for (unsigned seed = 0; seed < 30; ++seed) {
    for (const SourceMesh& surface : closed_surfaces(seed)) {
      HalfedgeMesh mesh = halfedges_of(surface);
      const int euler = euler_characteristic(mesh);
      simplify(mesh, surface.positions, 0);
      expect_closed_manifold(mesh);
      EXPECT_EQ(euler_characteristic(mesh), euler);
    }
  }
}

TEST(Simplify, IsUndoneToExactlyTheSameTrianglesAndTwins) {
  for (unsigned seed = 0; seed < 30; ++seed) {
    for (const SourceMesh& surface : closed_surfaces(seed)) {
      const HalfedgeMesh before = halfedges_of(surface);
      for (const std::int32_t target : {before.triangle_count() * 3 / 4, before.triangle_count() / 4, 0}) {
        HalfedgeMesh mesh = before;
        const auto removals = simplify(mesh, surface.positions, target);
        for (auto r = removals.rbegin(); r != removals.rend(); ++r) undo_removal(mesh, *r);
        EXPECT_EQ(mesh.triangles, before.triangles);
        EXPECT_EQ(mesh.twins, before.twins);
        expect_closed_manifold(mesh);  // the outgoing half-edges may be others, but are right
      }
    }
  }
}

TEST(Simplify, GivesAClosedManifoldAfterEveryRemovalAndEveryStepBack) {
  for (unsigned seed = 0; seed < 5; ++seed) {
    for (const SourceMesh& surface : {random_sphere(4, seed), random_torus(9, 7, seed)}) {
      HalfedgeMesh mesh = halfedges_of(surface);
      const int euler = euler_characteristic(mesh);
      RemovalGuard guard;
      guard.removed = [&](const Removal& r) {
        expect_closed_manifold(mesh);
        EXPECT_EQ(mesh.outgoing[r.vertex], -1);
        return true;
      };
      auto removals = simplify(mesh, surface.positions, 0, guard);
      for (; !removals.empty(); removals.pop_back()) {
        undo_removal(mesh, removals.back());
        expect_closed_manifold(mesh);
        EXPECT_EQ(euler_characteristic(mesh), euler);
      }
    }
  }
}

TEST(Simplify, KeepsWhatTheGuardKeepsAndTakesBackWhatItRefuses) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    for (const SourceMesh& surface : closed_surfaces(seed)) {
      const HalfedgeMesh before = halfedges_of(surface);
      HalfedgeMesh mesh = before;
      std::mt19937 random(seed);
      RemovalGuard guard;
      guard.may_remove = [](VertexId v) { return v % 3 != 0; };
      guard.removed = [&](const Removal&) { return random() % 4 != 0; };
      const auto removals = simplify(mesh, surface.positions, before.triangle_count() / 3, guard);
      expect_closed_manifold(mesh);
      for (VertexId v = 0; v < mesh.vertex_count(); v += 3) EXPECT_GE(mesh.outgoing[v], 0);
      for (auto r = removals.rbegin(); r != removals.rend(); ++r) undo_removal(mesh, *r);
      EXPECT_EQ(mesh.triangles, before.triangles);
      EXPECT_EQ(mesh.twins, before.twins);
    }
  }
}

}  // namespace
}  // namespace lozenge
