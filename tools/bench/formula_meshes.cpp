#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "tools/bench/bench_mesh.h"
#include "tools/bench/mesh_file.h"

namespace lozenge::bench {
namespace {

constexpr double kGolden = std::numbers::phi;
constexpr std::array<std::array<double, 3>, 12> kCorners{{{-1, kGolden, 0},
                                                          {1, kGolden, 0},
                                                          {-1, -kGolden, 0},
                                                          {1, -kGolden, 0},
                                                          {0, -1, kGolden},
                                                          {0, 1, kGolden},
                                                          {0, -1, -kGolden},
                                                          {0, 1, -kGolden},
                                                          {kGolden, 0, -1},
                                                          {kGolden, 0, 1},
                                                          {-kGolden, 0, -1},
                                                          {-kGolden, 0, 1}}};
constexpr std::array<std::array<int, 3>, 20> kFaces{{{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                                                     {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                                                     {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                                                     {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}}};

/// A point of a face. Corners are taken in the order of their numbers, so that two faces give the same bits on the edge
/// that they share.
Vec3f on_sphere(const std::array<int, 3>& face, const std::array<int, 3>& weights) {
  std::array<int, 3> order{0, 1, 2};
  std::sort(order.begin(), order.end(), [&](int a, int b) { return face[a] < face[b]; });
  Vec3d sum(0, 0, 0);
  for (const int k : order) {
    const auto& [x, y, z] = kCorners[face[k]];
    sum += Vec3d(x, y, z) * static_cast<double>(weights[k]);
  }
  return Vec3f(sum.normalized());
}

void add_face(Surface& mesh, const std::array<int, 3>& face, int n) {
  const auto first = static_cast<VertexId>(mesh.positions.size());
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i + j <= n; ++i) mesh.positions.push_back(on_sphere(face, {n - i - j, i, j}));
  }
  const auto at = [&](int i, int j) { return first + j * (n + 1) - j * (j - 1) / 2 + i; };
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i + j < n; ++i) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i, j + 1)});
      if (i + j + 1 < n) mesh.triangles.push_back({at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
}

constexpr double kTubeRadius = 0.4;

Vec3f on_torus(double u, double v) {
  const double radius = 1 + kTubeRadius * std::cos(v);
  return Vec3f(Vec3d(radius * std::cos(u), radius * std::sin(u), kTubeRadius * std::sin(v)));
}

}  // namespace

Surface sphere_mesh(std::int32_t triangles) {
  const int n = std::max(1, static_cast<int>(std::lround(std::sqrt(triangles / 20.0))));
  Surface mesh;
  for (const auto& face : kFaces) add_face(mesh, face, n);
  return welded(mesh);
}

Surface torus_mesh(std::int32_t triangles) {
  const int across = std::max(3, static_cast<int>(std::lround(std::sqrt(triangles / 2.0 * kTubeRadius))));
  const int along = std::max(3, static_cast<int>(std::lround(triangles / 2.0 / across)));
  Surface mesh;
  for (int u = 0; u < along; ++u) {
    for (int v = 0; v < across; ++v) {
      mesh.positions.push_back(on_torus(2 * std::numbers::pi * u / along, 2 * std::numbers::pi * v / across));
      const int right = (u + 1) % along;
      const int up = (v + 1) % across;
      mesh.triangles.push_back({u * across + v, right * across + v, right * across + up});
      mesh.triangles.push_back({u * across + v, right * across + up, u * across + up});
    }
  }
  return mesh;
}

}  // namespace lozenge::bench
