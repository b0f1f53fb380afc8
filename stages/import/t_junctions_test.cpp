#include "stages/import/t_junctions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "formats/surface/attribute_fixtures.h"
#include "formats/surface/attribute_streams.h"
#include "formats/surface/canonical_form.h"
#include "formats/surface/surface_facts.h"
#include "stages/import/repair.h"
#include "stages/import/surface_fixtures.h"

namespace lozenge {
namespace {

using namespace testing_surfaces;

/// A square of n strips on its left half and one quad on its right half: n - 1 vertices on the quad's left edge.
SourceMesh square_with_one_long_edge(int n) {
  SourceMesh mesh;
  const auto add = [&](float x, float y) {
    mesh.positions.emplace_back(x, y, 0.0F);
    return static_cast<VertexId>(mesh.positions.size()) - 1;
  };
  std::vector<VertexId> left, middle;
  for (int i = 0; i <= n; ++i) {
    const auto y = static_cast<float>(i) / static_cast<float>(n);
    left.push_back(add(-1, y));
    middle.push_back(add(0, y));
  }
  for (int i = 0; i < n; ++i) {
    mesh.triangles.push_back({left[i], middle[i], middle[i + 1]});
    mesh.triangles.push_back({left[i], middle[i + 1], left[i + 1]});
  }
  const VertexId a = add(1, 0);
  const VertexId b = add(1, 1);
  mesh.triangles.push_back({middle[0], a, b});
  mesh.triangles.push_back({middle[0], b, middle[n]});
  make_canonical(mesh);
  return mesh;
}

struct Joined {
  SourceMesh mesh;
  RepairReport report;
};
Joined joined_up(SourceMesh mesh) {
  Joined result{std::move(mesh), {}};
  join_t_junctions(result.mesh, result.report);
  return result;
}

double area_of(const SourceMesh& mesh) { return surface_area(mesh.positions, mesh.triangles); }

TEST(TJunctions, AreJoinedIntoTheLongEdgeAndNothingIsOpenThere) {
  for (const int n : {2, 3, 7, 200}) {
    const SourceMesh mesh = square_with_one_long_edge(n);
    const Joined result = joined_up(mesh);
    EXPECT_EQ(result.report[RepairKind::kTJunctions].count, n - 1);
    EXPECT_EQ(result.mesh.triangles.size(), mesh.triangles.size() + static_cast<std::size_t>(n) - 1);
    const SurfaceFacts facts = surface_facts(result.mesh);
    EXPECT_EQ(facts.boundary_loops, 1);
    EXPECT_EQ(facts.boundary_edges, n + 5);
    EXPECT_EQ(facts.euler, 1);
    EXPECT_NEAR(area_of(result.mesh), area_of(mesh), 1e-6);
  }
}

TEST(TJunctions, AreJoinedHoweverTheSurfaceIsTurnedAndScaled) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> any(-1, 1);
  for (int i = 0; i < 100; ++i) {
    SourceMesh mesh = square_with_one_long_edge(5);
    const Vec3f axis = Vec3f(any(random), any(random), any(random)).normalized();
    const Vec3f side = axis.cross(Vec3f(any(random), any(random), any(random))).normalized();
    const Vec3f up = axis.cross(side);
    const float scale = std::pow(10.0F, 3 * any(random));
    const Vec3f shift = Vec3f(any(random), any(random), any(random)) * scale;
    for (Vec3f& p : mesh.positions) p = (axis * p.x + side * p.y) * scale + up * p.z + shift;
    EXPECT_EQ(joined_up(mesh).report[RepairKind::kTJunctions].count, 4) << i;
  }
}

TEST(TJunctions, OfBothSidesOfACrackAreJoined) {
  // Two strips along each other, of three and of four pieces.
  SourceMesh mesh;
  const auto strip = [&](int n, float low, float high) {
    const auto first = static_cast<VertexId>(mesh.positions.size());
    for (int i = 0; i <= n; ++i) {
      mesh.positions.emplace_back(12.0F * static_cast<float>(i) / static_cast<float>(n), low, 0.0F);
      mesh.positions.emplace_back(12.0F * static_cast<float>(i) / static_cast<float>(n), high, 0.0F);
    }
    for (int i = 0; i < n; ++i) {
      const VertexId v = first + 2 * i;
      mesh.triangles.push_back({v, v + 2, v + 1});
      mesh.triangles.push_back({v + 2, v + 3, v + 1});
    }
  };
  strip(3, 0, 1);
  strip(4, 1, 2);
  // Their corners are one vertex each, as welding makes them.
  for (auto& t : mesh.triangles) {
    for (VertexId& v : t) {
      v = static_cast<VertexId>(std::find(mesh.positions.begin(), mesh.positions.end(), mesh.positions[v]) -
                                mesh.positions.begin());
    }
  }
  make_canonical(mesh);
  const Joined result = joined_up(mesh);
  EXPECT_EQ(result.report[RepairKind::kTJunctions].count, 2 + 3);
  EXPECT_EQ(surface_facts(result.mesh).euler, 1);
  EXPECT_EQ(surface_facts(result.mesh).boundary_loops, 1);
}

TEST(TJunctions, GetTheAttributesThatLieAlongTheEdge) {
  SourceMesh mesh = square_with_one_long_edge(4);
  AttributeStream uvs{kTextureCoordinates, 0, {}};
  for (const auto& t : mesh.triangles) {
    for (const VertexId v : t) uvs.values.insert(uvs.values.end(), {mesh.positions[v].x, mesh.positions[v].y});
  }
  mesh.corner_attributes.push_back(uvs);
  const Joined result = joined_up(mesh);
  const AttributeStream* stream = find_stream(result.mesh.corner_attributes, kTextureCoordinates);
  ASSERT_NE(stream, nullptr);
  ASSERT_EQ(stream->count(), 3 * result.mesh.triangles.size());
  for (std::size_t c = 0; c < stream->count(); ++c) {
    const Vec3f& p = result.mesh.positions[result.mesh.triangles[c / 3][c % 3]];
    EXPECT_NEAR(stream->at(c)[0], p.x, 1e-6);
    EXPECT_NEAR(stream->at(c)[1], p.y, 1e-6);
  }
}

TEST(TJunctions, OnSeveralSidesOfOneTriangleAreAllJoined) {
  // A large triangle, each of whose sides has five small ones along it.
  SourceMesh mesh;
  const std::array<Vec3f, 3> corners{Vec3f(0, 0, 0), Vec3f(4, 0, 0), Vec3f(0, 4, 0)};
  const std::array<Vec3f, 3> outward{Vec3f(0, -1, 0), Vec3f(1, 1, 0), Vec3f(-1, 0, 0)};
  for (const Vec3f& p : corners) mesh.positions.push_back(p);
  mesh.triangles.push_back({0, 1, 2});
  constexpr int kPieces = 4;
  for (int s = 0; s < 3; ++s) {
    VertexId last = s;
    for (int i = 1; i <= kPieces; ++i) {
      const float share = static_cast<float>(i) / kPieces;
      const Vec3f at = corners[s] * (1 - share) + corners[(s + 1) % 3] * share;
      VertexId next = (s + 1) % 3;
      if (i < kPieces) {
        next = static_cast<VertexId>(mesh.positions.size());
        mesh.positions.push_back(at);
      }
      mesh.positions.push_back(at + outward[s]);
      mesh.triangles.push_back({next, last, static_cast<VertexId>(mesh.positions.size()) - 1});
      last = next;
    }
  }
  make_canonical(mesh);
  const double area = area_of(mesh);
  Joined result = joined_up(mesh);
  EXPECT_EQ(result.report[RepairKind::kTJunctions].count, 3 * (kPieces - 1));
  EXPECT_NEAR(area_of(result.mesh), area, 1e-5);
  EXPECT_EQ(surface_facts(result.mesh).euler, 1);
  // Every side inside has its twin: what is left open is two sides of each small triangle.
  EXPECT_EQ(surface_facts(result.mesh).boundary_edges, 2 * 3 * kPieces);
}

TEST(TJunctions, AreNoneWhereTheSurfaceIsClosedOrMerelyTouches) {
  for (const SourceMesh& mesh : {sphere(5), torus(6, 7)}) {
    Joined result = joined_up(mesh);
    EXPECT_TRUE(result.report.none());
    EXPECT_EQ(result.mesh.triangles, mesh.triangles);
  }
  // A triangle that stands with its tip on another's edge goes away from there.
  SourceMesh touching;
  touching.positions = {{0, 0, 0}, {2, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0.5F, -1, 0}, {1.5F, -1, 0}};
  touching.triangles = {{0, 1, 2}, {3, 4, 5}};
  EXPECT_TRUE(joined_up(touching).report.none());
}

TEST(TJunctions, AreLeftWhereThousandsOfEdgesLieOnEachOther) {
  SourceMesh pile;
  constexpr int kTriangles = 3000;
  std::mt19937 random(3);
  std::uniform_real_distribution<float> any(0, 1);
  for (int i = 0; i < kTriangles; ++i) {
    const auto first = static_cast<VertexId>(pile.positions.size());
    pile.positions.emplace_back(any(random), 0.0F, 0.0F);
    pile.positions.emplace_back(1 + any(random), 0.0F, 0.0F);
    pile.positions.emplace_back(any(random), 1.0F, any(random));
    pile.triangles.push_back({first, first + 1, first + 2});
  }
  const Joined result = joined_up(pile);
  EXPECT_TRUE(result.report.none());
  EXPECT_EQ(result.mesh.triangles.size(), static_cast<std::size_t>(kTriangles));
}

}  // namespace
}  // namespace lozenge
