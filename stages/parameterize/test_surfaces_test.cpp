#include "stages/parameterize/test_surfaces.h"

#include <array>
#include <cmath>
#include <random>

#include "formats/sphere_fixtures.h"

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

SourceMesh beside(const SourceMesh& first, const SourceMesh& second, double distance) {
  SourceMesh both = first;
  const auto offset = static_cast<VertexId>(first.positions.size());
  for (const Vec3f& p : second.positions) both.positions.push_back(p + Vec3f(static_cast<float>(distance), 0, 0));
  for (const auto& [a, b, c] : second.triangles) both.triangles.push_back({a + offset, b + offset, c + offset});
  return both;
}

}  // namespace lozenge::test
