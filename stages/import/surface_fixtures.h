// Surfaces that the tests of import damage and mend.
#pragma once

#include <cmath>
#include <numbers>

#include "formats/domain/sphere_fixtures.h"
#include "formats/surface/source_mesh.h"

namespace lozenge::testing_surfaces {

/// A torus of m x n quads, cut along diagonals.
inline SourceMesh torus(int m, int n) {
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

inline SourceMesh sphere(int n) { return fixtures::subdivided_sphere(fixtures::octahedron(), n).first; }

inline SourceMesh joined(SourceMesh a, const SourceMesh& b) {
  const auto first = static_cast<VertexId>(a.positions.size());
  for (const Vec3f& p : b.positions) a.positions.push_back(p + Vec3f(10, 0, 0));
  for (const auto& [i, j, k] : b.triangles) a.triangles.push_back({first + i, first + j, first + k});
  return a;
}

/// A closed band of `n` quads in space with so many half twists.
inline SourceMesh band(int n, int half_twists) {
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

}  // namespace lozenge::testing_surfaces
