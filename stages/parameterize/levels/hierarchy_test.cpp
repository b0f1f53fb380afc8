// Large meshes are simplified in blocks, on all threads, and the proxy is a mesh of its own.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>

#include "formats/domain/sphere_fixtures.h"
#include "stages/parameterize/levels/proxy.h"
#include "stages/parameterize/levels/simplify.h"
#include "stages/parameterize/levels/simplify_in_blocks.h"
#include "stages/parameterize/map/map_energy.h"
#include "stages/parameterize/map_fixtures.h"
#include "stages/parameterize/surface_fixtures.h"

namespace lozenge {
namespace {

HalfedgeMesh halfedges(const SourceMesh& mesh) {
  return make_halfedge_mesh(mesh.triangles, static_cast<std::int32_t>(mesh.positions.size()));
}

TEST(ProxySize, GrowsWithTheRootOfLargeDomains) {
  const ProxySize size{40, 2000};
  EXPECT_EQ(size.triangles_for(20), 2000);
  EXPECT_EQ(size.triangles_for(100), 4000);
  EXPECT_EQ(size.triangles_for(200), 8000);
  EXPECT_EQ(size.triangles_for(800), 16000);
}

std::vector<std::pair<Halfedge, VertexId>> flattened(const Hierarchy& hierarchy) {
  std::vector<std::pair<Halfedge, VertexId>> all;
  for (const Blocks& round : hierarchy.rounds) {
    for (const auto& block : round) {
      for (const Removal& r : block) all.emplace_back(std::max(r.left, r.right), r.vertex);
      all.emplace_back(-1, -1);
    }
  }
  for (const Removal& r : hierarchy.coarser) all.emplace_back(std::max(r.left, r.right), r.vertex);
  return all;
}

TEST(SimplifyInBlocks, RemovesTheSameVerticesOnAnyNumberOfThreadsAndBringsBackTheSameMesh) {
  // 160,002 vertices: enough for several blocks, and for a second round of them.
  const SourceMesh mesh = test::sphere(200, test::random_relief(0.2, 5));
  const HalfedgeMesh whole = halfedges(mesh);
  std::vector<std::vector<std::pair<Halfedge, VertexId>>> runs;
  for (const std::size_t threads : {1, 2}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    HalfedgeMesh simplified = whole;
    Hierarchy hierarchy = simplify_in_blocks(simplified, mesh.positions, 2000);
    ASSERT_EQ(hierarchy.rounds.size(), 2U);
    EXPECT_GT(hierarchy.rounds.front().size(), 2U);
    for (const Blocks& round : hierarchy.rounds) EXPECT_FALSE(round.front().empty());
    runs.push_back(flattened(hierarchy));
    for (auto r = hierarchy.coarser.rbegin(); r != hierarchy.coarser.rend(); ++r) undo_removal(simplified, *r);
    for (auto round = hierarchy.rounds.rbegin(); round != hierarchy.rounds.rend(); ++round) {
      for (const auto& block : *round) {
        for (auto r = block.rbegin(); r != block.rend(); ++r) undo_removal(simplified, *r);
      }
    }
    EXPECT_EQ(simplified.triangles, whole.triangles);
    EXPECT_EQ(simplified.twins, whole.twins);
  }
  EXPECT_EQ(runs[0], runs[1]);
}

TEST(SimplifyInBlocks, KeepsTheVerticesThatItIsToldToKeep) {
  const SourceMesh mesh = test::sphere(40, test::random_relief(0.2, 6));
  HalfedgeMesh simplified = halfedges(mesh);
  const std::vector<VertexId> keep{0, 17, 1000, 1001, 1002, 3000};
  simplify_in_blocks(simplified, mesh.positions, 300, keep);
  for (const VertexId v : keep) EXPECT_GE(simplified.outgoing[v], 0);
}

TEST(Proxy, IsTheSimplifiedMeshWithoutGapsAndItsMapThatOfTheWhole) {
  const SourceMesh mesh = test::sphere(20, test::random_relief(0.2, 7));
  HalfedgeMesh simplified = halfedges(mesh);
  const std::vector<Removal> removals = simplify(simplified, mesh.positions, 800);
  const Proxy proxy = extract_proxy(simplified, mesh.positions);
  ASSERT_FALSE(removals.empty());
  EXPECT_EQ(proxy.vertices.size() + removals.size(), mesh.positions.size());
  for (TriangleId t = 0; t < proxy.mesh.triangle_count(); ++t) {
    for (int c = 0; c < 3; ++c) {
      EXPECT_EQ(proxy.vertices[proxy.mesh.triangles[t][c]], simplified.triangles[proxy.triangles[t]][c]);
      EXPECT_EQ(proxy.triangles[proxy.mesh.twins[3 * t + c] / 3], simplified.twins[3 * proxy.triangles[t] + c] / 3);
    }
  }
  const WorkingMap small = trivial_map(proxy.positions, proxy.mesh);
  const WorkingMap whole = map_of_simplified(small, proxy, simplified, mesh.positions);
  test::expect_sound(whole);
  EXPECT_NEAR(total_energy(whole), total_energy(small), 1e-9);
}

}  // namespace
}  // namespace lozenge
