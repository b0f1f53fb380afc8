#include "stages/import/surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "formats/base/error.h"
#include "stages/import/surface_fixtures.h"

namespace lozenge {
namespace {

using namespace testing_surfaces;

void expect_refused(const SourceMesh& mesh, const std::vector<std::string>& texts,
                    ExitCode code = ExitCode::kUnsupported) {
  try {
    require_manifold(mesh, "statue.glb");
    ADD_FAILURE() << "was not refused; expected a message about " << texts.front();
  } catch (const Error& error) {
    const std::string message = error.what();
    EXPECT_EQ(error.code(), code) << message;
    EXPECT_EQ(message.find("statue.glb: "), 0U) << message;
    for (const std::string& text : texts)
      EXPECT_NE(message.find(text), std::string::npos) << message << "\nlacks " << text;
  }
}

TEST(RequireManifold, GivesTheFactsOfSurfacesOfAnyGenusAndNumber) {
  const SurfaceFacts ball = require_manifold(sphere(7), "sphere");
  EXPECT_EQ(ball.components, 1);
  EXPECT_EQ(ball.euler, 2);
  EXPECT_EQ(ball.boundary_edges, 0);
  EXPECT_EQ(ball.triangles, 8 * 49);
  EXPECT_EQ(ball.vertices, 4 * 49 + 2);
  EXPECT_EQ(require_manifold(torus(5, 4), "torus").euler, 0);
  const SurfaceFacts two = require_manifold(joined(sphere(3), torus(4, 4)), "two");
  EXPECT_EQ(two.components, 2);
  EXPECT_EQ(two.euler, 2);
}

TEST(RequireManifold, LinksEveryHalfEdgeToTheOneThatRunsBack) {
  const SourceMesh mesh = joined(sphere(5), torus(6, 9));
  const HalfEdgeLinks links = link_half_edges(mesh);
  ASSERT_EQ(links.twins.size(), 3 * mesh.triangles.size());
  EXPECT_EQ(links.edges * 2, static_cast<std::int64_t>(links.twins.size()));
  for (HalfEdge h = 0; h < static_cast<HalfEdge>(links.twins.size()); ++h) {
    const HalfEdge twin = links.twins[h];
    ASSERT_GE(twin, 0);
    EXPECT_EQ(links.twins[twin], h);
    EXPECT_EQ(half_edge_start(mesh, h), half_edge_end(mesh, twin));
    EXPECT_EQ(half_edge_end(mesh, h), half_edge_start(mesh, twin));
  }
}

TEST(RequireManifold, RefusesAMeshWithoutTriangles) {
  expect_refused(SourceMesh(), {"no triangles"}, ExitCode::kUnusableInput);
}

TEST(RequireManifold, CountsTheEdgesOfEveryHole) {
  std::mt19937 random(3);
  for (int i = 0; i < 50; ++i) {
    SourceMesh mesh = i % 2 == 0 ? sphere(4) : torus(6, 5);
    mesh.triangles.erase(mesh.triangles.begin() + static_cast<long>(random() % mesh.triangles.size()));
    const SurfaceFacts facts = require_manifold(mesh, "holed");
    EXPECT_EQ(facts.boundary_edges, 3);
    EXPECT_EQ(facts.boundary_loops, 1);
  }
}

TEST(RequireManifold, FindsASingleTurnedTriangleAnywhere) {
  std::mt19937 random(4);
  for (int i = 0; i < 50; ++i) {
    SourceMesh mesh = i % 2 == 0 ? sphere(4) : torus(6, 5);
    auto& triangle = mesh.triangles[random() % mesh.triangles.size()];
    std::swap(triangle[0], triangle[1]);
    expect_refused(mesh, {"disagree", "3 such edges", "consistent"});
  }
}

TEST(RequireManifold, TellsAMoebiusStripFromABand) {
  for (const int n : {3, 4, 5, 12, 101}) {
    expect_refused(band(n, 1), {"one-sided", "Moebius"});
    expect_refused(band(n, 3), {"one-sided", "Moebius"});
    for (const int turns : {0, 2}) EXPECT_EQ(require_manifold(band(n, turns), "band").boundary_loops, 2);
  }
}

TEST(RequireManifold, FindsAnEdgeOfThreeTriangles) {
  SourceMesh mesh = sphere(3);
  const auto [a, b, c] = mesh.triangles[5];
  mesh.positions.push_back({9, 9, 9});
  mesh.triangles.push_back({a, b, static_cast<VertexId>(mesh.positions.size()) - 1});
  expect_refused(mesh, {"three or more triangles share an edge", "3 triangle sides"});
}

TEST(RequireManifold, FindsDuplicateTriangles) {
  SourceMesh mesh = sphere(3);
  mesh.triangles.push_back(mesh.triangles[7]);
  expect_refused(mesh, {"three or more triangles share an edge", "9 triangle sides"});
}

TEST(RequireManifold, FindsABowTieWhereTwoPartsTouch) {
  SourceMesh mesh = joined(sphere(3), sphere(2));
  // The second sphere's first vertex becomes the first one's.
  const auto second = static_cast<VertexId>(sphere(3).positions.size());
  for (auto& triangle : mesh.triangles) std::replace(triangle.begin(), triangle.end(), second, VertexId{0});
  expect_refused(mesh, {"touch in a single vertex", "1 such vertex"});
}

TEST(RequireManifold, StaysFastAroundAVertexOfVeryManyTriangles) {
  // A bipyramid over a polygon of n corners: a bucket of n half-edges. Quadratic work would take minutes.
  const int n = 200000;
  SourceMesh mesh;
  mesh.positions = {{0, 0, 1}, {0, 0, -1}};
  for (int i = 0; i < n; ++i) {
    const double u = 2 * std::numbers::pi * i / n;
    mesh.positions.push_back(Vec3f(Vec3d(std::cos(u), std::sin(u), 0)));
  }
  for (int i = 0; i < n; ++i) {
    const VertexId a = 2 + i;
    const VertexId b = 2 + (i + 1) % n;
    mesh.triangles.push_back({0, a, b});
    mesh.triangles.push_back({1, b, a});
  }
  EXPECT_EQ(require_manifold(mesh, "bipyramid").euler, 2);
  for (int i = 0; i < n; i += 2) std::swap(mesh.triangles[2 * i][0], mesh.triangles[2 * i][1]);
  expect_refused(mesh, {"disagree"});
}

}  // namespace
}  // namespace lozenge
