// Every shape is what the tests that use it take for granted.
#include "test_assets/shape.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <string>
#include <tuple>

namespace lozenge::test_assets {
namespace {

struct Case {
  std::string name;
  Shape shape;
  int euler;
};

std::vector<Case> all() {
  return {{"icosphere", icosphere(3), 2},
          {"octasphere", octasphere(3), 2},
          {"bumpy sphere", bumpy_sphere(), 2},
          {"torus", torus(1, 0.4, 96, 40), 0},
          {"knot", knot(), 0},
          {"uneven", uneven(), 2},
          {"genus 3", genus3(), -4}};
}

std::vector<Case> all_open() {
  return {{"disk", disk(5), 1},
          {"annulus", annulus(24, 4), 0},
          {"hemisphere", hemisphere(3), 1},
          {"plane", plane(10, 5), 1},
          {"single triangle", single_triangle(), 1}};
}

const std::vector<Case>& cases() {
  static const std::vector<Case> made = all();
  return made;
}

const std::vector<Case>& open_cases() {
  static const std::vector<Case> made = all_open();
  return made;
}

using Sides = std::set<std::pair<int, int>>;

/// Sides of triangles with their direction; nothing where two are the same.
Sides oriented_sides(const Shape& shape) {
  Sides sides;
  for (const auto& t : shape.triangles) {
    for (int k = 0; k < 3; ++k) {
      if (!sides.emplace(t[k], t[(k + 1) % 3]).second) return {};
    }
  }
  return sides;
}

std::ptrdiff_t boundary_edges(const Sides& sides) {
  return std::count_if(sides.begin(), sides.end(), [&](const auto& side) {
    return sides.count({side.second, side.first}) == 0;
  });
}

/// Around every vertex the triangles form one ring, so that walking from one of them visits all.
bool one_ring_around_every_vertex(const Shape& shape) {
  std::map<std::pair<int, int>, int> next;  // (vertex, side's end) -> the next side's end
  std::vector<int> valence(shape.positions.size(), 0);
  std::vector<int> start(shape.positions.size(), -1);
  for (const auto& t : shape.triangles) {
    for (int k = 0; k < 3; ++k) {
      next[{t[k], t[(k + 1) % 3]}] = t[(k + 2) % 3];
      start[t[k]] = t[(k + 1) % 3];
      ++valence[t[k]];
    }
  }
  for (int v = 0; v < static_cast<int>(shape.positions.size()); ++v) {
    int steps = 0;
    int at = start[v];
    do {
      at = next[{v, at}];
      ++steps;
    } while (at != start[v] && steps <= valence[v]);
    if (steps != valence[v]) return false;
  }
  return true;
}

double smallest_area(const Shape& shape) {
  double smallest = 1e9;
  for (const auto& [a, b, c] : shape.triangles) {
    const Vec3d origin(shape.positions[a]);
    const Vec3d normal = (Vec3d(shape.positions[b]) - origin).cross(Vec3d(shape.positions[c]) - origin);
    smallest = std::min(smallest, normal.length() / 2);
  }
  return smallest;
}

TEST(Shapes, AreClosedOrientedManifolds) {
  for (const Case& c : cases()) {
    EXPECT_FALSE(oriented_sides(c.shape).empty()) << c.name;
    EXPECT_EQ(boundary_edges(oriented_sides(c.shape)), 0) << c.name;
    EXPECT_TRUE(one_ring_around_every_vertex(c.shape)) << c.name;
  }
}

TEST(Shapes, HaveTheEulerCharacteristicThatTheirNamePromises) {
  for (const Case& c : cases()) {
    const auto triangles = static_cast<int>(c.shape.triangles.size());
    EXPECT_EQ(static_cast<int>(c.shape.positions.size()) - triangles / 2, c.euler) << c.name;
  }
}

TEST(OpenShapes, AreOrientedAndHaveTheEulerCharacteristicThatTheirNamePromises) {
  for (const Case& c : open_cases()) {
    const Sides sides = oriented_sides(c.shape);
    const auto boundary = static_cast<int>(boundary_edges(sides));
    EXPECT_GT(boundary, 0) << c.name;
    const int edges = (static_cast<int>(sides.size()) + boundary) / 2;
    const auto vertices = static_cast<int>(c.shape.positions.size());
    EXPECT_EQ(vertices - edges + static_cast<int>(c.shape.triangles.size()), c.euler) << c.name;
  }
}

TEST(OpenShapes, FaceUp) {
  for (const Case& c : open_cases()) {
    for (const Vec3f& normal : smooth_normals(c.shape)) EXPECT_GE(normal.z, 0) << c.name;
  }
}

TEST(Shapes, FaceOutwards) {
  for (const Case& c : cases()) EXPECT_GT(signed_volume(c.shape), 0) << c.name;
}

TEST(Shapes, HaveNoTwoVerticesInOnePlaceAndNoTriangleWithoutArea) {
  std::vector<Case> both = cases();
  both.insert(both.end(), open_cases().begin(), open_cases().end());
  for (const Case& c : both) {
    std::set<std::tuple<float, float, float>> places;
    for (const Vec3f& p : c.shape.positions) {
      ASSERT_TRUE(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z)) << c.name;
      places.emplace(p.x, p.y, p.z);
    }
    EXPECT_EQ(places.size(), c.shape.positions.size()) << c.name;
    EXPECT_GT(smallest_area(c.shape), 0) << c.name;
  }
}

TEST(Shapes, AreTheSameBitsEveryTime) {
  const std::vector<Case> again = all();
  for (std::size_t k = 0; k < again.size(); ++k) {
    EXPECT_EQ(again[k].shape.positions, cases()[k].shape.positions) << again[k].name;
    EXPECT_EQ(again[k].shape.triangles, cases()[k].shape.triangles) << again[k].name;
  }
  const std::vector<Case> open_again = all_open();
  for (std::size_t k = 0; k < open_again.size(); ++k) {
    EXPECT_EQ(open_again[k].shape.positions, open_cases()[k].shape.positions) << open_again[k].name;
    EXPECT_EQ(open_again[k].shape.triangles, open_cases()[k].shape.triangles) << open_again[k].name;
  }
}

TEST(Uneven, HasTrianglesOfVeryDifferentSizes) {
  const Shape shape = uneven();
  double largest = 0;
  for (const auto& [a, b, c] : shape.triangles) {
    const Vec3d origin(shape.positions[a]);
    const Vec3d normal = (Vec3d(shape.positions[b]) - origin).cross(Vec3d(shape.positions[c]) - origin);
    largest = std::max(largest, normal.length() / 2);
  }
  EXPECT_GT(largest / smallest_area(shape), 1e4);  // a scan stays below 100
}

TEST(SmoothNormals, PointOutOfASphere) {
  const Shape sphere = icosphere(4);
  const std::vector<Vec3f> normals = smooth_normals(sphere);
  for (std::size_t v = 0; v < normals.size(); ++v) {
    EXPECT_GT(normals[v].dot(sphere.positions[v]), 0.999F);  // edges are 4 degrees long
  }
}

TEST(ImplicitSurface, LiesOnTheZeroSetOfItsField) {
  const auto field = [](const Vec3d& p) { return p.length() - 1; };
  const Shape sphere = implicit_surface(field, Vec3d(-1.2, -1.2, -1.2), Vec3d(1.2, 1.2, 1.2), 0.1, 5);
  for (const Vec3f& p : sphere.positions) EXPECT_NEAR(p.length(), 1, 1e-6);
  EXPECT_EQ(static_cast<int>(sphere.positions.size()) - static_cast<int>(sphere.triangles.size()) / 2, 2);
}

}  // namespace
}  // namespace lozenge::test_assets
