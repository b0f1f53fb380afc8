#include "stages/pack/pack.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "formats/base/error.h"
#include "formats/domain/sphere_fixtures.h"
#include "formats/patches/geometry_image_check.h"
#include "formats/patches/image_fixtures.h"
#include "formats/patches/level_mesh.h"
#include "formats/surface/boundary.h"
#include "formats/surface/mesh_statistics.h"

namespace lozenge {
namespace {

bool same_bits(const Vec3f& a, const Vec3f& b) { return std::memcmp(&a, &b, sizeof(Vec3f)) == 0; }

std::vector<PatchSet> patch_sets() {
  std::vector<PatchSet> found;
  for (const Domain& base : {fixtures::tetrahedron(), fixtures::octahedron(), fixtures::icosahedron()}) {
    for (const int k : {0, 1, 2, 5}) found.push_back(fixtures::sphere_patches(base, k));
  }
  return found;
}

TEST(Pack, KeepsEverySampleInItsTileAndEverySecondOneInTheNextLevel) {
  for (const PatchSet& patches : patch_sets()) {
    for (const std::int32_t columns : {0, 1, 5, patches.size()}) {
      const GeometryImage image = pack(patches, {columns});
      std::int32_t stride = 1;
      for (const GeometryLevel& level : image.levels) {
        EXPECT_EQ((level.samples - 1) * stride, patches.layout.samples - 1);
        for (std::int32_t p = 0; p < patches.size(); ++p) {
          for (std::int32_t j = 0; j < level.samples; ++j) {
            for (std::int32_t i = 0; i < level.samples; ++i) {
              const std::size_t from = patches.index(p, i * stride, j * stride);
              const std::size_t to = image.index(level, p, i, j);
              EXPECT_TRUE(same_bits(level.positions[to], patches.positions[from]));
              EXPECT_TRUE(same_bits(level.normals[to], patches.normals[from]));
            }
          }
        }
        stride *= 2;
      }
      EXPECT_EQ(image.levels.back().samples, 2);
      EXPECT_EQ(find_defect(image), std::nullopt);
    }
  }
}

TEST(Pack, MovesTheMarksOfCapsWithTheirSamples) {
  for (PatchSet patches : patch_sets()) {
    for (const Vec3f& p : patches.positions) patches.caps.push_back(p.y > 0.25F ? 1 : 0);
    const GeometryImage image = pack(patches);
    for (std::int32_t p = 0; p < patches.size(); ++p) {
      for (std::int32_t j = 0; j < patches.layout.samples; ++j) {
        for (std::int32_t i = 0; i < patches.layout.samples; ++i) {
          EXPECT_EQ(image.on_cap(0, p, i, j), patches.positions[patches.index(p, i, j)].y > 0.25F);
        }
      }
    }
    EXPECT_EQ(find_defect(image), std::nullopt);
  }
}

TEST(Pack, MakesTheSquarestAtlasWithoutAnEmptyRow) {
  for (const PatchSet& patches : patch_sets()) {
    const GeometryImage image = pack(patches);
    EXPECT_GE(image.columns * image.columns, patches.size());
    EXPECT_LT((image.columns - 1) * (image.columns - 1), patches.size());
    EXPECT_GE(image.columns * image.rows_on(0), patches.size());
    EXPECT_LT(image.columns * (image.rows_on(0) - 1), patches.size());
  }
}

TEST(Pack, EveryLevelIsAClosedMeshWithTheDomainsIrregularVertices) {
  for (const PatchSet& patches : patch_sets()) {
    const GeometryImage image = pack(patches);
    std::int32_t domain_vertices = 0;
    for (const PatchPlace& place : patches.layout.places)
      domain_vertices = std::max({domain_vertices, place.a + 1, place.b + 1});
    for (std::size_t l = 0; l < image.levels.size(); ++l) {
      const LevelMesh mesh = level_mesh(image, static_cast<int>(l));
      const MeshStatistics facts = mesh_statistics(mesh.view());
      EXPECT_TRUE(is_closed_manifold(facts));
      EXPECT_EQ(facts.euler, 2);
      EXPECT_EQ(facts.triangles, static_cast<std::int64_t>(patches.size()) * 2 * (mesh.grids.samples(0) - 1) *
                                     (mesh.grids.samples(0) - 1));
      // The vertices of the three domains are all irregular.
      const std::vector<std::int32_t> irregular = irregular_vertices(mesh);
      EXPECT_EQ(static_cast<std::int32_t>(irregular.size()), domain_vertices);
      for (std::int32_t p = 0; p < patches.size(); ++p) {
        EXPECT_TRUE(std::binary_search(irregular.begin(), irregular.end(), mesh.vertex(p, 0, 0)));
        EXPECT_TRUE(std::binary_search(irregular.begin(), irregular.end(),
                                       mesh.vertex(p, mesh.grids.samples(p) - 1, mesh.grids.samples(p) - 1)));
      }
    }
  }
}

TEST(Pack, KeepsTheLoopsOfABoundaryAtEveryLevel) {
  for (const fixtures::OpenSurface& open : fixtures::open_surfaces()) {
    const GeometryImage image = pack(fixtures::open_patches(open, 4));
    EXPECT_EQ(find_defect(image), std::nullopt) << open.name;
    for (std::size_t l = 0; l < image.levels.size(); ++l) {
      const LevelMesh mesh = level_mesh(image, static_cast<int>(l));
      const MeshStatistics facts = mesh_statistics(mesh.view());
      EXPECT_EQ(facts.tangled_edges + facts.pinched_vertices, 0) << open.name << ", level " << l;
      EXPECT_EQ(facts.euler, open.euler) << open.name << ", level " << l;
      const std::vector<BoundarySide> sides = boundary_sides(mesh.view());
      EXPECT_EQ(static_cast<int>(boundary_loops(sides).size()), open.loops) << open.name << ", level " << l;
      // Every level's boundary vertices are points of the source's boundary.
      const double off = fixtures::boundary_distance(mesh.view(), {open.mesh.positions, open.mesh.triangles});
      EXPECT_LT(off, 2e-7) << open.name << ", level " << l;
    }
  }
}

TEST(Pack, LeavesTheHalvesBeyondTheBoundaryZero) {
  for (const fixtures::OpenSurface& open : fixtures::open_surfaces()) {
    const GeometryImage image = pack(fixtures::open_patches(open, 3));
    for (const GeometryLevel& level : image.levels) {
      for (std::int32_t p = 0; p < image.size(); ++p) {
        for (std::int32_t j = 0; j < level.samples; ++j) {
          for (std::int32_t i = j + 1; i < level.samples && !image.layout.places[p].right.exists(); ++i) {
            EXPECT_TRUE(same_bits(level.positions[image.index(level, p, i, j)], Vec3f(0, 0, 0)));
            EXPECT_TRUE(same_bits(level.normals[image.index(level, p, i, j)], Vec3f(0, 0, 0)));
          }
        }
      }
    }
  }
}

TEST(Pack, RefusesColumnsThatDoNotFit) {
  const PatchSet patches = fixtures::sphere_patches(fixtures::tetrahedron(), 1);
  for (const std::int32_t columns : {-1, 7, 1 << 30}) EXPECT_THROW(pack(patches, {columns}), Error);
}

TEST(FindDefect, NamesTheSampleThatBreaksAPromise) {
  const GeometryImage good = pack(fixtures::sphere_patches(fixtures::octahedron(), 2));
  const auto after = [&](auto change) {
    GeometryImage bad = good;
    change(bad);
    return find_defect(bad).value_or("");
  };
  EXPECT_NE(after([&](GeometryImage& g) {
              g.levels[0].positions[g.index(g.levels[0], 7, 3, 1)] *= 2.0F;
            }).find("sample (3, 1) of patch 7, level 0"),
            std::string::npos);
  EXPECT_NE(after([&](GeometryImage& g) {
              g.levels[1].normals[g.index(g.levels[1], 7, 1, 1)] *= -1.0F;
            }).find("sample (1, 1) of patch 7, level 1"),
            std::string::npos);
}

}  // namespace
}  // namespace lozenge
