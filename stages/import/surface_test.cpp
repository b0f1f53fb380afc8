#include "stages/import/surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "formats/error.h"
#include "formats/sphere_fixtures.h"

namespace lozenge {
namespace {

/// A torus of m x n quads, cut along diagonals.
SourceMesh torus(int m, int n) {
  SourceMesh mesh;
  for (int i = 0; i < m; ++i) {
    for (int j = 0; j < n; ++j) {
      const double u = 2 * std::numbers::pi * i / m;
      const double v = 2 * std::numbers::pi * j / n;
      mesh.positions.push_back(
          Vec3f(Vec3d((2 + std::cos(v)) * std::cos(u), (2 + std::cos(v)) * std::sin(u), std::sin(v))));
    }
  }
  const auto id = [&](int i, int j) { return (i % m) * n + j % n; };
  for (int i = 0; i < m; ++i) {
    for (int j = 0; j < n; ++j) {
      mesh.triangles.push_back({id(i, j), id(i + 1, j), id(i, j + 1)});
      mesh.triangles.push_back({id(i + 1, j), id(i + 1, j + 1), id(i, j + 1)});
    }
  }
  return mesh;
}

SourceMesh sphere(int n) { return fixtures::subdivided_sphere(fixtures::octahedron(), n).first; }

SourceMesh joined(SourceMesh a, const SourceMesh& b) {
  const auto first = static_cast<VertexId>(a.positions.size());
  for (const Vec3f& p : b.positions) a.positions.push_back(p + Vec3f(10, 0, 0));
  for (const auto& [i, j, k] : b.triangles) a.triangles.push_back({first + i, first + j, first + k});
  return a;
}

/// A closed band of `n` quads in space with so many half twists.
SourceMesh band(int n, int half_twists) {
  SourceMesh mesh;
  for (int i = 0; i < n; ++i) {
    const double u = 2 * std::numbers::pi * i / n;
    const double turn = half_twists * u / 2;
    for (const double side : {-0.5, 0.5}) {
      const double r = 2 + side * std::cos(turn);
      mesh.positions.push_back(Vec3f(Vec3d(r * std::cos(u), r * std::sin(u), side * std::sin(turn))));
    }
  }
  for (int i = 0; i < n; ++i) {
    const bool crossed = i + 1 == n && half_twists % 2 != 0;
    const int next = 2 * ((i + 1) % n);
    const VertexId c = next + (crossed ? 1 : 0);
    const VertexId d = next + (crossed ? 0 : 1);
    mesh.triangles.push_back({2 * i, c, 2 * i + 1});
    mesh.triangles.push_back({c, d, 2 * i + 1});
  }
  return mesh;
}

void expect_refused(const SourceMesh& mesh, const std::vector<std::string>& texts,
                    ExitCode code = ExitCode::kUnsupported) {
  try {
    require_closed_surface(mesh, "statue.glb");
    ADD_FAILURE() << "was not refused; expected a message about " << texts.front();
  } catch (const Error& error) {
    const std::string message = error.what();
    EXPECT_EQ(error.code(), code) << message;
    EXPECT_EQ(message.find("statue.glb: "), 0U) << message;
    for (const std::string& text : texts)
      EXPECT_NE(message.find(text), std::string::npos) << message << "\nlacks " << text;
  }
}

TEST(RequireClosedSurface, GivesTheFactsOfClosedSurfacesOfAnyGenusAndNumber) {
  const SurfaceFacts ball = require_closed_surface(sphere(7), "sphere");
  EXPECT_EQ(ball.components, 1);
  EXPECT_EQ(ball.euler, 2);
  EXPECT_EQ(ball.triangles, 8 * 49);
  EXPECT_EQ(ball.vertices, 4 * 49 + 2);
  EXPECT_EQ(require_closed_surface(torus(5, 4), "torus").euler, 0);
  const SurfaceFacts two = require_closed_surface(joined(sphere(3), torus(4, 4)), "two");
  EXPECT_EQ(two.components, 2);
  EXPECT_EQ(two.euler, 2);
}

TEST(RequireClosedSurface, LinksEveryHalfEdgeToTheOneThatRunsBack) {
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

TEST(RequireClosedSurface, RefusesAMeshWithoutTriangles) {
  expect_refused(SourceMesh(), {"no triangles"}, ExitCode::kUnusableInput);
}

TEST(RequireClosedSurface, CountsTheEdgesOfEveryHole) {
  std::mt19937 random(3);
  for (int i = 0; i < 50; ++i) {
    SourceMesh mesh = i % 2 == 0 ? sphere(4) : torus(6, 5);
    mesh.triangles.erase(mesh.triangles.begin() + static_cast<long>(random() % mesh.triangles.size()));
    expect_refused(mesh, {"open", "3 edges belong to one triangle only", "from (", "close its holes"});
  }
}

TEST(RequireClosedSurface, FindsASingleTurnedTriangleAnywhere) {
  std::mt19937 random(4);
  for (int i = 0; i < 50; ++i) {
    SourceMesh mesh = i % 2 == 0 ? sphere(4) : torus(6, 5);
    auto& triangle = mesh.triangles[random() % mesh.triangles.size()];
    std::swap(triangle[0], triangle[1]);
    expect_refused(mesh, {"disagree", "3 such edges", "consistent"});
  }
}

TEST(RequireClosedSurface, TellsAMoebiusStripFromABand) {
  for (const int n : {3, 4, 5, 12, 101}) {
    expect_refused(band(n, 1), {"one-sided", "Moebius"});
    expect_refused(band(n, 3), {"one-sided", "Moebius"});
    expect_refused(band(n, 0), {"open"});
    expect_refused(band(n, 2), {"open"});
  }
}

TEST(RequireClosedSurface, FindsAnEdgeOfThreeTriangles) {
  SourceMesh mesh = sphere(3);
  const auto [a, b, c] = mesh.triangles[5];
  mesh.positions.push_back({9, 9, 9});
  mesh.triangles.push_back({a, b, static_cast<VertexId>(mesh.positions.size()) - 1});
  expect_refused(mesh, {"three or more triangles share an edge", "3 triangle sides"});
}

TEST(RequireClosedSurface, FindsDuplicateTriangles) {
  SourceMesh mesh = sphere(3);
  mesh.triangles.push_back(mesh.triangles[7]);
  expect_refused(mesh, {"three or more triangles share an edge", "9 triangle sides"});
}

TEST(RequireClosedSurface, FindsABowTieWhereTwoPartsTouch) {
  SourceMesh mesh = joined(sphere(3), sphere(2));
  // The second sphere's first vertex becomes the first one's.
  const auto second = static_cast<VertexId>(sphere(3).positions.size());
  for (auto& triangle : mesh.triangles) std::replace(triangle.begin(), triangle.end(), second, VertexId{0});
  expect_refused(mesh, {"touch in a single vertex", "1 such vertex"});
}

TEST(RequireClosedSurface, StaysFastAroundAVertexOfVeryManyTriangles) {
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
  EXPECT_EQ(require_closed_surface(mesh, "bipyramid").euler, 2);
  for (int i = 0; i < n; i += 2) std::swap(mesh.triangles[2 * i][0], mesh.triangles[2 * i][1]);
  expect_refused(mesh, {"disagree"});
}

}  // namespace
}  // namespace lozenge
