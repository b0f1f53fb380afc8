// The canonical order keeps every triangle as it was: its material, its corners' positions and attributes.
#include "formats/surface/canonical_form.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <tuple>

#include "formats/surface/attribute_fixtures.h"

namespace lozenge {
namespace {

/// A strip of triangles of three materials, each corner with a texture coordinate of its own.
SourceMesh strip(int count, unsigned seed) {
  std::mt19937 random(seed);
  SourceMesh mesh;
  for (int v = 0; v < count + 2; ++v) mesh.positions.emplace_back(static_cast<float>(v), static_cast<float>(v % 2), 0);
  for (int t = 0; t < count; ++t) {
    mesh.triangles.push_back({t, t + 1 + t % 2, t + 2 - t % 2});
    mesh.materials.push_back(static_cast<std::int32_t>(random() % 3));
    for (int c = 0; c < 3; ++c)
      fixtures::add_corner(mesh, kTextureCoordinates, Vec2f(static_cast<float>(t), static_cast<float>(c)));
  }
  mesh.material_names = {"a", "b", "c"};
  return mesh;
}

using Corner = std::tuple<float, float, float, float>;  // position, texture coordinate
using Facts = std::tuple<std::int32_t, std::array<Corner, 3>>;

std::vector<Facts> facts_of(const SourceMesh& mesh) {
  std::vector<Facts> facts;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    std::array<Corner, 3> corners;
    for (std::size_t c = 0; c < 3; ++c) {
      const Vec3f& p = mesh.positions[mesh.triangles[t][c]];
      const Vec2f uv = fixtures::corner_uvs(mesh)[3 * t + c];
      corners[c] = {p.x, p.y, uv.x, uv.y};
    }
    facts.emplace_back(mesh.materials[t], corners);
  }
  return facts;
}

void expect_canonical(const SourceMesh& mesh) {
  EXPECT_TRUE(std::is_sorted(mesh.materials.begin(), mesh.materials.end()));
  VertexId next = 0;
  for (const auto& triangle : mesh.triangles) {
    for (const VertexId v : triangle) {
      ASSERT_LE(v, next);
      next = std::max(next, v + 1);
    }
  }
  EXPECT_EQ(next, static_cast<VertexId>(mesh.positions.size()));
}

TEST(CanonicalForm, TakesEachMaterialsTrianglesInTheOrderGiven) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const SourceMesh before = strip(40, seed);
    std::vector<TriangleId> order(before.triangles.size());
    std::iota(order.begin(), order.end(), 0);
    std::shuffle(order.begin(), order.end(), std::mt19937(seed));
    SourceMesh after = before;
    const std::vector<VertexId> number = make_canonical(after, order);
    expect_canonical(after);
    for (std::size_t v = 0; v < number.size(); ++v) EXPECT_EQ(after.positions[number[v]], before.positions[v]);
    const std::vector<Facts> facts = facts_of(before);
    std::vector<Facts> wanted;
    for (const TriangleId t : order) wanted.push_back(facts[t]);
    std::stable_sort(wanted.begin(), wanted.end(),
                     [](const Facts& a, const Facts& b) { return std::get<0>(a) < std::get<0>(b); });
    EXPECT_EQ(facts_of(after), wanted);
  }
}

TEST(CanonicalForm, CarriesAttributesThatItKnowsNothingOf) {
  for (unsigned seed = 0; seed < 5; ++seed) {
    SourceMesh mesh = strip(40, seed);
    fixtures::plant_attributes(mesh);
    std::vector<TriangleId> order(mesh.triangles.size());
    std::iota(order.begin(), order.end(), 0);
    std::shuffle(order.begin(), order.end(), std::mt19937(seed));
    make_canonical(mesh, order);
    fixtures::expect_planted_attributes(mesh);
  }
}

TEST(CanonicalForm, LeavesWhatIsCanonicalAsItIs) {
  SourceMesh mesh = strip(40, 7);
  make_canonical(mesh);
  SourceMesh again = mesh;
  const std::vector<VertexId> number = make_canonical(again);
  EXPECT_TRUE(std::is_sorted(number.begin(), number.end()));
  EXPECT_EQ(again.triangles, mesh.triangles);
  EXPECT_EQ(again.positions, mesh.positions);
  EXPECT_EQ(facts_of(again), facts_of(mesh));
}

TEST(CanonicalForm, DropsVerticesOfNoTriangle) {
  SourceMesh mesh = strip(4, 1);
  mesh.positions.insert(mesh.positions.begin(), Vec3f(9, 9, 9));
  for (auto& triangle : mesh.triangles) {
    for (VertexId& v : triangle) ++v;
  }
  const std::vector<VertexId> number = make_canonical(mesh);
  EXPECT_EQ(number[0], -1);
  expect_canonical(mesh);
}

}  // namespace
}  // namespace lozenge
