#include "stages/parameterize/surface_fixtures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "formats/domain/sphere_fixtures.h"
#include "stages/parameterize/map/halfedge_mesh.h"
#include "stages/parameterize/parts.h"

namespace lozenge::test {

SourceMesh torus(int around, int along, double tube, const std::function<double(double, double)>& relief) {
  SourceMesh mesh;
  mesh.origin = "torus";
  for (int i = 0; i < around; ++i) {
    for (int j = 0; j < along; ++j) {
      const double u = 2 * M_PI * i / around;
      const double v = 2 * M_PI * j / along;
      const double r = tube + relief(u, v);
      mesh.positions.emplace_back(static_cast<float>((1 + r * std::cos(v)) * std::cos(u)),
                                  static_cast<float>((1 + r * std::cos(v)) * std::sin(u)),
                                  static_cast<float>(r * std::sin(v)));
    }
  }
  const auto at = [&](int i, int j) { return (i % around) * along + j % along; };
  for (int i = 0; i < around; ++i) {
    for (int j = 0; j < along; ++j) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return mesh;
}

SourceMesh sphere(int n, const std::function<double(const Vec3d&)>& relief) {
  SourceMesh mesh = fixtures::subdivided_sphere(fixtures::octahedron(), n).first;
  for (Vec3f& p : mesh.positions) p = Vec3f(Vec3d(p) * (1 + relief(Vec3d(p))));
  return mesh;
}

std::function<double(const Vec3d&)> random_relief(double height, unsigned seed) {
  struct Wave {
    Vec3d direction;
    double phase;
  };
  constexpr int kWaves = 6;
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0, 3);
  std::uniform_real_distribution<double> turn(0, 2 * M_PI);
  std::vector<Wave> waves;
  for (int i = 0; i < kWaves; ++i) {
    const double x = normal(random), y = normal(random), z = normal(random);
    waves.push_back({Vec3d(x, y, z), turn(random)});
  }
  return [waves, height](const Vec3d& p) {
    double sum = 0;
    for (const Wave& w : waves) sum += std::sin(w.direction.dot(p) + w.phase);
    return height * sum / kWaves;
  };
}

SourceMesh sheet(int n, const std::function<double(const Vec3d&)>& relief) {
  SourceMesh mesh;
  mesh.origin = "sheet";
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; j <= n; ++j) {
      const Vec3d p(static_cast<double>(i) / n, static_cast<double>(j) / n, 0);
      mesh.positions.push_back(Vec3f(p + Vec3d(0, 0, relief(p))));
    }
  }
  const auto at = [&](int i, int j) { return i * (n + 1) + j; };
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return mesh;
}

SourceMesh band(int around, int along, double width) {
  SourceMesh mesh;
  mesh.origin = "band";
  for (int i = 0; i < around; ++i) {
    for (int j = 0; j <= along; ++j) {
      const double u = 2 * M_PI * i / around;
      mesh.positions.emplace_back(static_cast<float>(std::cos(u)), static_cast<float>(std::sin(u)),
                                  static_cast<float>(width * j / along));
    }
  }
  const auto at = [&](int i, int j) { return (i % around) * (along + 1) + j; };
  for (int i = 0; i < around; ++i) {
    for (int j = 0; j < along; ++j) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return mesh;
}

namespace {

/// Gives every fan of triangles around a vertex but the first a vertex of its own.
void part_fans(SourceMesh& mesh) {
  const HalfedgeMesh halfedges = make_halfedge_mesh(mesh.triangles, static_cast<std::int32_t>(mesh.positions.size()));
  std::vector<VertexId> vertex_of(halfedges.twins.size(), -1);  // [half-edge] the number of its start
  std::vector<char> used(mesh.positions.size(), 0);
  for (Halfedge h = 0; h < static_cast<Halfedge>(vertex_of.size()); ++h) {
    if (vertex_of[h] >= 0) continue;
    VertexId v = halfedges.start(h);
    if (used[v]) {
      mesh.positions.push_back(Vec3f(mesh.positions[v]));
      v = static_cast<VertexId>(mesh.positions.size()) - 1;
      used.push_back(0);
    }
    used[v] = 1;
    const Halfedge first = first_of_fan(halfedges, h);
    const Halfedge last = last_of_fan(halfedges, first);
    for (Halfedge out = first;; out = halfedges.next_around(out)) {
      vertex_of[out] = v;
      if (out == last) break;
    }
  }
  for (std::size_t h = 0; h < vertex_of.size(); ++h) mesh.triangles[h / 3][h % 3] = vertex_of[h];
}

}  // namespace

SourceMesh opened(const SourceMesh& mesh, int holes, double radius, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<Vec3d> centres;
  for (int i = 0; i < holes; ++i) centres.emplace_back(mesh.positions[random() % mesh.positions.size()]);
  SourceMesh open = mesh;
  std::erase_if(open.triangles, [&](const std::array<VertexId, 3>& t) {
    const Vec3d middle = (Vec3d(mesh.positions[t[0]]) + Vec3d(mesh.positions[t[1]]) + Vec3d(mesh.positions[t[2]])) / 3;
    return std::any_of(centres.begin(), centres.end(),
                       [&](const Vec3d& centre) { return (middle - centre).length() < radius; });
  });
  part_fans(open);
  std::vector<Part> parts = split_into_parts(open);
  return std::max_element(parts.begin(), parts.end(), [](const Part& a, const Part& b) { return a.area < b.area; })
      ->mesh;
}

SourceMesh beside(const SourceMesh& first, const SourceMesh& second, double distance) {
  SourceMesh both = first;
  const auto offset = static_cast<VertexId>(first.positions.size());
  for (const Vec3f& p : second.positions) both.positions.push_back(p + Vec3f(static_cast<float>(distance), 0, 0));
  for (const auto& [a, b, c] : second.triangles) both.triangles.push_back({a + offset, b + offset, c + offset});
  return both;
}

}  // namespace lozenge::test
