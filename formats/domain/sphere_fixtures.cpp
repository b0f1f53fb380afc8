#include "formats/domain/sphere_fixtures.h"

#include <array>
#include <cmath>
#include <map>
#include <random>

namespace lozenge::fixtures {

namespace {

const std::vector<Vec3d>& corners_of_tetrahedron() {
  static const std::vector<Vec3d> corners{{1, 1, 1}, {-1, -1, 1}, {-1, 1, -1}, {1, -1, -1}};
  return corners;
}
const std::vector<Vec3d>& corners_of_octahedron() {
  static const std::vector<Vec3d> corners{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  return corners;
}
const std::vector<Vec3d>& corners_of_icosahedron() {
  static const double g = (1 + std::sqrt(5.0)) / 2;
  static const std::vector<Vec3d> corners{{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                                          {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  return corners;
}

/// The convex hull's faces: every triple with all other corners on one side.
Domain hull(const std::vector<Vec3d>& p) {
  std::vector<std::array<DomainVertex, 3>> faces;
  const int n = static_cast<int>(p.size());
  for (int a = 0; a < n; ++a) {
    for (int b = 0; b < n; ++b) {
      for (int c = 0; c < n; ++c) {
        if (a >= b || a >= c || b == c) continue;
        const Vec3d normal = (p[b] - p[a]).cross(p[c] - p[a]);
        bool outermost = normal.dot(p[a]) > 1e-9;
        for (int d = 0; d < n && outermost; ++d) {
          outermost = d == a || d == b || d == c || normal.dot(p[d] - p[a]) < -1e-9;
        }
        if (outermost) faces.push_back({a, b, c});
      }
    }
  }
  return make_domain(faces, n);
}

}  // namespace

Domain tetrahedron() { return hull(corners_of_tetrahedron()); }
Domain octahedron() { return hull(corners_of_octahedron()); }
Domain icosahedron() { return hull(corners_of_icosahedron()); }

std::pair<SourceMesh, Parameterization> subdivided(const Domain& base, int n, const std::vector<Vec3d>& corners,
                                                   const std::function<Vec3d(const Vec3d&)>& lift) {
  SourceMesh mesh;
  Parameterization map{base, {}};
  // A grid point is known by its weights at domain vertices, which its triangles agree on.
  std::map<std::map<DomainVertex, int>, VertexId> known;
  const auto vertex = [&](DomainTriangleId t, int beta, int gamma) {
    const std::array<int, 3> weights{n - beta - gamma, beta, gamma};
    std::map<DomainVertex, int> key;
    Vec3d sum(0, 0, 0);
    for (int c = 0; c < 3; ++c) {
      if (weights[c] > 0) key[base.corner(t, c)] = weights[c];
      sum += corners[base.corner(t, c)] * weights[c];
    }
    const auto [at, fresh] = known.emplace(key, static_cast<VertexId>(mesh.positions.size()));
    if (fresh) {
      mesh.positions.push_back(Vec3f(lift(sum)));
      const std::int64_t v = kLatticeOne * gamma / n;
      map.phi.push_back(domain_point(t, {weights[0] == 0 ? kLatticeOne - v : kLatticeOne * beta / n, v}));
    }
    return at->second;
  };
  for (DomainTriangleId t = 0; t < base.size(); ++t) {
    for (int g = 0; g < n; ++g) {
      for (int b = 0; b + g < n; ++b) {
        mesh.triangles.push_back({vertex(t, b, g), vertex(t, b + 1, g), vertex(t, b, g + 1)});
        if (b + g + 1 < n)
          mesh.triangles.push_back({vertex(t, b + 1, g), vertex(t, b + 1, g + 1), vertex(t, b, g + 1)});
      }
    }
  }
  return {mesh, map};
}

std::pair<SourceMesh, Parameterization> subdivided_sphere(const Domain& base, int n) {
  const std::vector<Vec3d>& corners = base.vertex_count == 4   ? corners_of_tetrahedron()
                                      : base.vertex_count == 6 ? corners_of_octahedron()
                                                               : corners_of_icosahedron();
  auto made = subdivided(base, n, corners, [](const Vec3d& p) { return p.normalized(); });
  made.first.scene_name = "sphere";
  made.first.origin = "sphere.glb";
  return made;
}

void jitter(Parameterization& map, double distance, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> offset(-distance / 2, distance / 2);
  for (DomainPoint& p : map.phi) {
    if (p.alpha == 0 || p.beta == 0 || p.gamma() == 0) continue;
    const double alpha = p.alpha + offset(random);
    const double beta = p.beta + offset(random);
    if (alpha > 0 && beta > 0 && alpha + beta < 1) p = make_point(p.triangle, alpha, beta);
  }
}

}  // namespace lozenge::fixtures
