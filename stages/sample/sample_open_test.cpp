// Surfaces with a boundary: samples end exactly where the source does.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cstring>
#include <set>

#include "formats/domain/open_fixtures.h"
#include "formats/patches/level_mesh.h"
#include "formats/patches/patch_neighbours.h"
#include "formats/surface/boundary.h"
#include "formats/surface/mesh_statistics.h"
#include "stages/sample/remesh.h"
#include "stages/sample/sample.h"

namespace lozenge {
namespace {

constexpr std::int32_t kSamples[] = {2, 3, 9};

SurfaceView view(const SourceMesh& mesh) { return {mesh.positions, mesh.triangles}; }

/// Rounding of one float coordinate near 1, in each of three.
constexpr double kRounding = 2e-7;

TEST(SampleOpen, LeavesTheHalfBeyondTheBoundaryEmptyAndFillsAllElse) {
  for (const fixtures::OpenSurface& open : fixtures::open_surfaces()) {
    for (const std::int32_t n : kSamples) {
      const PatchSet set = sample(open.mesh, open.map, {n});
      for (std::int32_t p = 0; p < set.size(); ++p) {
        const bool half = !open.map.domain.neighbour(set.layout.places[p].left).exists();
        EXPECT_EQ(half, set.layout.adjacency[p][0].patch < 0);
        EXPECT_EQ(half, set.layout.adjacency[p][1].patch < 0);
        EXPECT_GE(std::min(set.layout.adjacency[p][2].patch, set.layout.adjacency[p][3].patch), 0);
        for (std::int32_t j = 0; j < set.grids.samples(p); ++j) {
          for (std::int32_t i = 0; i < set.grids.samples(p); ++i) {
            const std::size_t s = set.index(p, i, j);
            const bool empty = half && i > j;
            EXPECT_EQ(set.source_triangles[s] < 0, empty);
            EXPECT_TRUE(!empty || (set.positions[s] == Vec3f(0, 0, 0) && set.normals[s] == Vec3f(0, 0, 0)));
            EXPECT_TRUE(empty || std::abs(set.normals[s].length() - 1) < 1e-6F);
          }
        }
      }
    }
  }
}

TEST(SampleOpen, PutsTheDiagonalOfAHalfPatchOnOneSideOfTheSourcesBoundarySampleBySample) {
  for (const fixtures::OpenSurface& open : fixtures::open_surfaces()) {
    const std::vector<BoundarySide> sides = boundary_sides(view(open.mesh));
    const PatchSet set = sample(open.mesh, open.map, {17});
    for (std::int32_t p = 0; p < set.size(); ++p) {
      if (set.layout.places[p].right.exists()) continue;
      for (std::int32_t i = 0; i < set.layout.samples; ++i) {
        const std::size_t s = set.index(p, i, i);
        std::vector<VertexId> ends;
        Vec3d sum(0, 0, 0);
        for (int c = 0; c < 3; ++c) {
          const VertexId v = open.mesh.triangles[set.source_triangles[s]][c];
          // Exactly zero at the corner that isn't on the boundary.
          if (set.source_weights[s][c] != 0) ends.push_back(v);
          sum += Vec3d(open.mesh.positions[v]) * static_cast<double>(set.source_weights[s][c]);
        }
        EXPECT_TRUE(std::any_of(sides.begin(), sides.end(),
                                [&](const BoundarySide& side) {
                                  return std::all_of(ends.begin(), ends.end(),
                                                     [&](VertexId v) { return v == side[0] || v == side[1]; });
                                }))
            << open.name << ", patch " << p << ", sample " << i;
        EXPECT_LT((Vec3d(set.positions[s]) - sum).length(), kRounding);
      }
    }
  }
}

TEST(SampleOpen, WeldsIntoASurfaceThatEndsOnTheDiagonalsAloneInTheSourcesLoops) {
  for (const fixtures::OpenSurface& open : fixtures::open_surfaces()) {
    for (const std::int32_t n : kSamples) {
      const PatchSet set = sample(open.mesh, open.map, {n});
      const LevelMesh mesh = patch_mesh(set);
      const MeshStatistics facts = mesh_statistics(mesh.view());
      EXPECT_EQ(facts.tangled_edges, 0) << open.name << ", " << n;
      EXPECT_EQ(facts.pinched_vertices, 0) << open.name << ", " << n;
      EXPECT_EQ(facts.euler, open.euler) << open.name << ", " << n;
      std::vector<BoundarySide> diagonals;
      for (std::int32_t p = 0; p < set.size(); ++p) {
        for (std::int32_t i = 0; i + 1 < n && !set.layout.places[p].right.exists(); ++i) {
          diagonals.push_back({mesh.vertex(p, i, i), mesh.vertex(p, i + 1, i + 1)});
        }
      }
      std::sort(diagonals.begin(), diagonals.end());
      const std::vector<BoundarySide> sides = boundary_sides(mesh.view());
      EXPECT_EQ(sides, diagonals) << open.name << ", " << n;
      EXPECT_EQ(static_cast<int>(boundary_loops(sides).size()), open.loops);
      EXPECT_LT(fixtures::boundary_distance(mesh.view(), view(open.mesh)), kRounding) << open.name << ", " << n;
    }
  }
}

TEST(SampleOpen, HasTheDomainsIrregularVerticesAndThoseBesideTheBoundaryAlone) {
  for (const fixtures::OpenSurface& open : fixtures::open_surfaces()) {
    for (const std::int32_t n : kSamples) {
      const PatchSet set = sample(open.mesh, open.map, {n});
      const LevelMesh mesh = patch_mesh(set);
      // A half quad is one triangle instead of two at its inner corner.
      std::set<std::int32_t> beside;
      for (std::int32_t p = 0; p < set.size(); ++p) {
        for (std::int32_t i = 0; i + 1 < n && !set.layout.places[p].right.exists(); ++i)
          beside.insert(mesh.vertex(p, i, i + 1));
      }
      const std::vector<std::int32_t> irregular = irregular_vertices(mesh);
      EXPECT_EQ(irregular.size(), beside.size() + static_cast<std::size_t>(count_irregular(open.map.domain)))
          << open.name << ", " << n;
      for (const std::int32_t v : beside) EXPECT_TRUE(std::binary_search(irregular.begin(), irregular.end(), v));
    }
  }
}

TEST(SampleOpen, SharesBordersBitByBitUpToTheBoundary) {
  for (const fixtures::OpenSurface& open : fixtures::open_surfaces()) {
    const PatchSet set = sample(open.mesh, open.map, {9});
    const PatchNeighbours neighbours(set.layout);
    for (std::int32_t p = 0; p < set.size(); ++p) {
      for (std::int32_t k = 0; k < set.grids.samples(p); ++k) {
        for (int side = 0; side < 4; ++side) {
          const PatchSample here = neighbours.on_side({p, side}, k);
          if (!neighbours.exists(here)) continue;
          for (const PatchSample& name : neighbours.names(here)) {
            const std::size_t a = set.index(here.patch, here.i, here.j);
            const std::size_t b = set.index(name.patch, name.i, name.j);
            EXPECT_EQ(std::memcmp(&set.positions[a], &set.positions[b], sizeof(Vec3f)), 0) << open.name;
            EXPECT_EQ(set.source_triangles[a], set.source_triangles[b]) << open.name;
          }
        }
      }
    }
  }
}

TEST(SampleOpen, IsTheSameOnAnyNumberOfThreads) {
  for (const fixtures::OpenSurface& open : fixtures::open_surfaces()) {
    const PatchSet many = sample(open.mesh, open.map, {9});
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    const PatchSet alone = sample(open.mesh, open.map, {9});
    EXPECT_EQ(std::memcmp(many.positions.data(), alone.positions.data(), many.positions.size() * sizeof(Vec3f)), 0);
    EXPECT_EQ(many.source_triangles, alone.source_triangles);
  }
}

TEST(RemeshOpen, OfEveryPartitionEndsWhereTheSourceDoes) {
  for (const fixtures::OpenSurface& open : fixtures::open_surfaces()) {
    for (const Partition partition : {Partition::kFaces, Partition::kHalfDiamonds, Partition::kHalfStars}) {
      // Rates that are no powers of two: places on sides are rounded to the lattice.
      for (const std::int32_t rate : {1, 3, 7}) {
        const SourceMesh made = remesh(open.mesh, open.map, {partition, rate});
        const MeshStatistics facts = mesh_statistics(view(made));
        EXPECT_EQ(facts.tangled_edges, 0) << open.name;
        EXPECT_EQ(facts.pinched_vertices, 0) << open.name;
        EXPECT_EQ(facts.euler, open.euler) << open.name;
        EXPECT_EQ(static_cast<int>(boundary_loops(boundary_sides(view(made))).size()), open.loops) << open.name;
        EXPECT_LT(fixtures::boundary_distance(view(made), view(open.mesh)), kRounding) << open.name << ", " << rate;
      }
    }
  }
}

}  // namespace
}  // namespace lozenge
