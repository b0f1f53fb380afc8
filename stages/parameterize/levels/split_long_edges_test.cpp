#include "stages/parameterize/levels/split_long_edges.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "formats/base/file_fixtures.h"
#include "formats/files/source_mesh_file.h"
#include "formats/surface/attribute_fixtures.h"
#include "formats/surface/surface_facts.h"
#include "stages/parameterize/surface_fixtures.h"

namespace lozenge {
namespace {

constexpr std::int64_t kNoLimit = std::numeric_limits<std::int32_t>::max();

Vec3d triangle_vector(const SourceMesh& mesh, std::size_t t) {
  const auto& [a, b, c] = mesh.triangles[t];
  const Vec3d p(mesh.positions[a]);
  return (Vec3d(mesh.positions[b]) - p).cross(Vec3d(mesh.positions[c]) - p) / 2;
}

/// [material] area of its triangles; of all, where there are no materials.
std::vector<double> areas(const SourceMesh& mesh) {
  std::vector<double> sums(std::max<std::size_t>(1, mesh.material_names.size()), 0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    sums[mesh.materials.empty() ? 0 : mesh.materials[t]] += triangle_vector(mesh, t).length();
  }
  return sums;
}

double longest_edge(const SourceMesh& mesh) {
  double longest = 0;
  for (const auto& t : mesh.triangles) {
    for (int c = 0; c < 3; ++c) {
      longest = std::max(longest, (Vec3d(mesh.positions[t[c]]) - Vec3d(mesh.positions[t[(c + 1) % 3]])).length());
    }
  }
  return longest;
}

/// Vertices in the order of their first use, triangles by material.
bool is_canonical(const SourceMesh& mesh) {
  VertexId used = 0;
  for (const auto& t : mesh.triangles) {
    for (const VertexId v : t) {
      if (v > used) return false;
      used = std::max(used, v + 1);
    }
  }
  return used == static_cast<VertexId>(mesh.positions.size()) &&
         std::is_sorted(mesh.materials.begin(), mesh.materials.end());
}

void number_by_first_use(SourceMesh& mesh) {
  std::vector<VertexId> number(mesh.positions.size(), -1);
  std::vector<Vec3f> positions;
  for (auto& t : mesh.triangles) {
    for (VertexId& v : t) {
      if (number[v] < 0) {
        number[v] = static_cast<VertexId>(positions.size());
        positions.push_back(mesh.positions[v]);
      }
      v = number[v];
    }
  }
  mesh.positions = positions;
}

/// The attributes that the corners of the tests' meshes have: linear in the position (normals turn by an angle that
/// is), and others for each material, so that there are seams.
struct Attributes {
  Vec3f normal;
  Vec2f uv;
  Vec4f colour;
};
Attributes attributes_at(const Vec3f& p, int material) {
  const auto m = static_cast<float>(material);
  const float angle = (p.x + 2 * p.y - p.z) / 10 + m;
  return {{std::cos(angle), std::sin(angle), 0},
          {p.x * m + p.z + 1, p.y - p.x},
          Vec4f(0.5F) + Vec4f(p.x + p.y + p.z, m - p.y, p.z + 1, p.x * (1 + m)) / 200};
}

constexpr int kMaterials = 3;

/// Closed canonical meshes of spheres and tori, of few and partly long triangles, with materials and attributes.
std::vector<SourceMesh> random_meshes(unsigned seed) {
  std::mt19937 random(seed);
  const auto relief = test::random_relief(0.3, seed);
  const int n = 1 + static_cast<int>(random() % 4);
  std::vector<SourceMesh> meshes{test::sphere(n, relief), test::torus(3 + n, 3, 0.4, [](double, double) { return 0; })};
  meshes.push_back(test::beside(meshes[0], meshes[1], 4));
  for (SourceMesh& mesh : meshes) {
    // Some are much longer than wide.
    const auto stretch = static_cast<float>(1 + random() % 4);
    for (Vec3f& p : mesh.positions) p.x *= stretch;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      mesh.materials.push_back(static_cast<int>(random() % kMaterials));
    }
    std::sort(mesh.materials.begin(), mesh.materials.end());
    mesh.material_names = {"bronze", "glass", "wood"};
    number_by_first_use(mesh);
    for (std::size_t c = 0; c < 3 * mesh.triangles.size(); ++c) {
      const Attributes a = attributes_at(mesh.positions[mesh.triangles[c / 3][c % 3]], mesh.materials[c / 3]);
      fixtures::add_corner(mesh, kNormals, a.normal);
      fixtures::add_corner(mesh, kTextureCoordinates, a.uv);
      fixtures::add_corner(mesh, kColors, a.colour);
    }
  }
  return meshes;
}

template <typename Check>
void for_random_splits(Check&& check) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    for (const SourceMesh& mesh : random_meshes(seed)) {
      for (const double share : {0.9, 0.4, 0.15}) {
        const double longest = share * longest_edge(mesh);
        SCOPED_TRACE(testing::Message() << mesh.origin << ", seed " << seed << ", share " << share);
        check(mesh, split_long_edges(mesh, longest, kNoLimit), longest);
      }
    }
  }
}

TEST(SplitLongEdges, LeavesNoEdgeThatIsLonger) {
  for_random_splits([](const SourceMesh& mesh, const SourceMesh& split, double longest) {
    EXPECT_TRUE(has_longer_edge(mesh, longest));
    EXPECT_FALSE(has_longer_edge(split, longest));
    EXPECT_LE(longest_edge(split), longest * (1 + 1e-15));
    EXPECT_GT(split.triangles.size(), mesh.triangles.size());
  });
}

TEST(SplitLongEdges, SplitsNoEdgeWhoseMiddleCantBeGiven) {
  // A million away from the origin coordinates are multiples of 1/16: beside longer edges that have no middle, others
  // could be split without end.
  for (const int n : {2, 4, 7}) {
    SourceMesh mesh = test::sphere(n, [](const Vec3d&) { return 0; });
    for (Vec3f& p : mesh.positions) p += Vec3f(1e6F, 0, 0);
    const SourceMesh split = split_long_edges(mesh, 0.02, 100'000);
    EXPECT_GT(split.triangles.size(), mesh.triangles.size());
    EXPECT_LT(split.triangles.size(), 10'000U);
    EXPECT_NEAR(areas(split)[0], areas(mesh)[0], 0.02 * areas(mesh)[0]);
  }
}

TEST(SplitLongEdges, KeepsTheSurfacesAreaAndThatOfEveryMaterial) {
  for_random_splits([](const SourceMesh& mesh, const SourceMesh& split, double) {
    const auto before = areas(mesh), after = areas(split);
    // Middles are rounded to floats.
    for (int m = 0; m < kMaterials; ++m) EXPECT_NEAR(after[m], before[m], 1e-5 * (before[m] + 1e-3));
    EXPECT_EQ(split.material_names, mesh.material_names);
    EXPECT_EQ(split.materials.size(), split.triangles.size());
  });
}

TEST(SplitLongEdges, KeepsTheSurfaceClosedAndItsTopology) {
  for_random_splits([](const SourceMesh& mesh, const SourceMesh& split, double) {
    const HalfEdgeLinks links = link_half_edges(split);
    EXPECT_TRUE(std::all_of(links.twins.begin(), links.twins.end(), [](HalfEdge h) { return h >= 0; }));
    const SurfaceFacts before = surface_facts(mesh), after = surface_facts(split, links);
    EXPECT_EQ(after.euler, before.euler);
    EXPECT_EQ(after.components, before.components);
  });
}

TEST(SplitLongEdges, InterpolatesTheCornersAttributesLinearlyOnEitherSideOfASeam) {
  for_random_splits([](const SourceMesh&, const SourceMesh& split, double) {
    const std::size_t corners = 3 * split.triangles.size();
    ASSERT_EQ(fixtures::corner_normals(split).size(), corners);
    ASSERT_EQ(fixtures::corner_uvs(split).size(), corners);
    ASSERT_EQ(fixtures::corner_colors(split).size(), corners);
    constexpr float kRounding = 1e-4F;  // values of up to some tens, in floats
    for (std::size_t c = 0; c < corners; ++c) {
      const Attributes a = attributes_at(split.positions[split.triangles[c / 3][c % 3]], split.materials[c / 3]);
      ASSERT_LT((fixtures::corner_normals(split)[c] - a.normal).length(), kRounding);
      ASSERT_LT((fixtures::corner_uvs(split)[c] - a.uv).length(), kRounding);
      ASSERT_LT((fixtures::corner_colors(split)[c] - a.colour).length(), kRounding);
    }
  });
}

TEST(SplitLongEdges, CarriesAttributesThatItKnowsNothingOf) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    for (SourceMesh& mesh : random_meshes(seed)) {
      fixtures::plant_attributes(mesh);
      fixtures::expect_planted_attributes(split_long_edges(mesh, 0.3 * longest_edge(mesh), kNoLimit));
    }
  }
}

TEST(SplitLongEdges, GivesTheCanonicalForm) {
  for_random_splits([](const SourceMesh& mesh, const SourceMesh& split, double) {
    ASSERT_TRUE(is_canonical(mesh));
    EXPECT_TRUE(is_canonical(split));
  });
}

TEST(SplitLongEdges, GivesWhatAFileGivesBackBitByBit) {
  const fixtures::TestFolder folder;
  for_random_splits([&](const SourceMesh&, const SourceMesh& split, double) {
    write_source_mesh(folder / "split.mesh.glb", split);
    const SourceMesh read = read_source_mesh(folder / "split.mesh.glb");
    EXPECT_EQ(read.positions, split.positions);
    EXPECT_EQ(read.triangles, split.triangles);
    EXPECT_TRUE(fixtures::same_bits(read.corner_attributes, split.corner_attributes));
  });
}

TEST(SplitLongEdges, KeepsEveryVertex) {
  for_random_splits([](const SourceMesh& mesh, const SourceMesh& split, double) {
    const auto less = [](const Vec3f& a, const Vec3f& b) {
      return std::array<float, 3>{a.x, a.y, a.z} < std::array<float, 3>{b.x, b.y, b.z};
    };
    auto before = mesh.positions, after = split.positions;
    std::sort(before.begin(), before.end(), less);
    std::sort(after.begin(), after.end(), less);
    EXPECT_TRUE(std::includes(after.begin(), after.end(), before.begin(), before.end(), less));
  });
}

TEST(SplitLongEdges, TurnsNoTriangleOver) {
  for_random_splits([](const SourceMesh& mesh, const SourceMesh& split, double) {
    // A closed surface encloses the same volume; one flipped triangle would change it.
    const auto volume = [](const SourceMesh& m) {
      double sum = 0;
      for (std::size_t t = 0; t < m.triangles.size(); ++t) {
        sum += triangle_vector(m, t).dot(Vec3d(m.positions[m.triangles[t][0]])) / 3;
      }
      return sum;
    };
    EXPECT_NEAR(volume(split), volume(mesh), 1e-5 * std::abs(volume(mesh)));
  });
}

TEST(SplitLongEdges, GivesBackTheSameMeshWhereNothingIsTooLong) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    for (const SourceMesh& mesh : random_meshes(seed)) {
      const double longest = 1.0001 * longest_edge(mesh);
      EXPECT_FALSE(has_longer_edge(mesh, longest));
      const SourceMesh split = split_long_edges(mesh, longest, static_cast<std::int64_t>(mesh.triangles.size()));
      EXPECT_EQ(split.positions, mesh.positions);
      EXPECT_EQ(split.triangles, mesh.triangles);
      EXPECT_TRUE(fixtures::same_bits(split.corner_attributes, mesh.corner_attributes));
      EXPECT_EQ(split.materials, mesh.materials);
    }
  }
}

TEST(SplitLongEdges, NeedsNeitherAttributesNorMaterials) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    SourceMesh mesh = test::sphere(2, test::random_relief(0.2, seed));
    number_by_first_use(mesh);
    const double longest = 0.3 * longest_edge(mesh);
    const SourceMesh split = split_long_edges(mesh, longest, kNoLimit);
    EXPECT_FALSE(has_longer_edge(split, longest));
    EXPECT_TRUE(split.corner_attributes.empty());
    EXPECT_TRUE(split.materials.empty());
    EXPECT_TRUE(is_canonical(split));
  }
}

TEST(SplitLongEdges, StopsWhereItWouldMakeTooManyTriangles) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    for (const SourceMesh& mesh : random_meshes(seed)) {
      const double longest = 0.3 * longest_edge(mesh);
      const SourceMesh whole = split_long_edges(mesh, longest, kNoLimit);
      const auto needed = static_cast<std::int64_t>(whole.triangles.size());
      const auto given = static_cast<std::int64_t>(mesh.triangles.size());
      EXPECT_EQ(split_long_edges(mesh, longest, needed + 1).triangles, whole.triangles);
      for (const std::int64_t most : {std::int64_t{0}, given, (given + needed) / 2, needed - 1}) {
        const SourceMesh split = split_long_edges(mesh, longest, most);
        EXPECT_LE(static_cast<std::int64_t>(split.triangles.size()), std::max(most, given));
        EXPECT_GE(static_cast<std::int64_t>(split.triangles.size()), std::min(most - 1, needed));
        EXPECT_TRUE(is_canonical(split));
        EXPECT_NEAR(surface_area(split.positions, split.triangles), surface_area(mesh.positions, mesh.triangles),
                    1e-5 * surface_area(mesh.positions, mesh.triangles));
      }
    }
  }
}

}  // namespace
}  // namespace lozenge
