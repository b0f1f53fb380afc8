#include "formats/domain/open_fixtures.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "formats/domain/sphere_fixtures.h"
#include "formats/surface/boundary.h"

namespace lozenge::fixtures {

namespace {

OpenSurface named(const std::string& name, std::pair<SourceMesh, Parameterization> made, int loops, int euler) {
  made.first.scene_name = name;
  made.first.origin = name + ".glb";
  // -0 is never stored.
  for (Vec3f& p : made.first.positions) p += Vec3f(0, 0, 0);
  return {name, std::move(made.first), std::move(made.second), loops, euler};
}

/// The faces of a whole domain that `keep` accepts, with the source triangles on them; everything is numbered anew.
std::pair<SourceMesh, Parameterization> part_of_sphere(const Domain& whole, int n,
                                                       const std::function<bool(const DomainTriangle&)>& keep) {
  const auto [sphere, all] = subdivided_sphere(whole, 1);  // its vertices are the domain's
  std::vector<Vec3d> corners(static_cast<std::size_t>(whole.vertex_count));
  for (std::size_t v = 0; v < sphere.positions.size(); ++v) {
    corners[vertex_at(whole, all.phi[v])] = Vec3d(sphere.positions[v]);
  }
  std::vector<std::array<DomainVertex, 3>> kept;
  std::vector<DomainVertex> number(corners.size(), -1);
  std::vector<Vec3d> places;
  for (const DomainTriangle& t : whole.triangles) {
    if (!keep(t)) continue;
    kept.push_back(t.corners);
    for (DomainVertex& v : kept.back()) {
      if (number[v] < 0) {
        number[v] = static_cast<DomainVertex>(places.size());
        places.push_back(corners[v]);
      }
      v = number[v];
    }
  }
  return subdivided(make_domain(kept, static_cast<DomainVertex>(places.size())), n, places,
                    [](const Vec3d& p) { return p.normalized(); });
}

/// A place on the band: u along it in domain sides, v across it, 0..1.
DomainPoint on_band(int sectors, std::int64_t u, std::int64_t v) {
  const std::int64_t around = sectors * kLatticeOne;
  u = ((u % around) + around) % around;
  const std::int64_t k = u / kLatticeOne;
  const std::int64_t in = u - k * kLatticeOne;
  const auto lower = static_cast<DomainTriangleId>(2 * k);
  if (in + v <= kLatticeOne) return domain_point(lower, {in, v});
  const std::int64_t gamma = kLatticeOne - in;
  return domain_point(lower + 1, {v - gamma, gamma});
}

}  // namespace

OpenSurface triangle(int n) {
  const std::vector<Vec3d> corners{{0, 0, 0}, {1, 0, 0}, {0.4, 0.9, 0}};
  const auto lift = [n](const Vec3d& p) {
    const Vec3d q = p / n;
    return Vec3d(q.x, q.y, 0.3 * q.x * (1 - q.y) + 0.2 * q.y * q.y);
  };
  return named("triangle", subdivided(make_domain({{0, 1, 2}}, 3), n, corners, lift), 1, 1);
}

OpenSurface hemisphere(int n) {
  // Corners 4 and 5 are the poles.
  const auto upper = [](const DomainTriangle& t) { return std::count(t.corners.begin(), t.corners.end(), 4) == 1; };
  return named("hemisphere", part_of_sphere(octahedron(), n, upper), 1, 1);
}

OpenSurface bowl(int n) {
  const auto away = [](const DomainTriangle& t) { return std::count(t.corners.begin(), t.corners.end(), 0) == 0; };
  return named("bowl", part_of_sphere(icosahedron(), n, away), 1, 1);
}

OpenSurface fan(int triangles, int n) {
  std::vector<Vec3d> corners{{0, 0, 0}};
  std::vector<std::array<DomainVertex, 3>> faces;
  const double step = std::min(60.0, 320.0 / triangles) * std::numbers::pi / 180;
  for (int k = 0; k <= triangles; ++k) {
    corners.emplace_back(std::cos(k * step), std::sin(k * step), 0.1 * (k % 2));
    if (k > 0) faces.push_back({0, k, k + 1});
  }
  const auto lift = [n](const Vec3d& p) { return p / n; };
  return named("fan_" + std::to_string(triangles), subdivided(make_domain(faces, triangles + 2), n, corners, lift), 1,
               1);
}

OpenSurface annulus(int sectors, int columns, int rows, double shift) {
  std::vector<std::array<DomainVertex, 3>> faces;
  for (int k = 0; k < sectors; ++k) {
    const int next = (k + 1) % sectors;
    faces.push_back({k, next, sectors + k});
    faces.push_back({next, sectors + next, sectors + k});
  }
  SourceMesh mesh;
  Parameterization map{make_domain(faces, 2 * sectors), {}};
  for (int r = 0; r <= rows; ++r) {
    for (int c = 0; c < columns; ++c) {
      const double along = sectors * (c + 0.3 * r) / columns + shift;
      const double across = static_cast<double>(r) / rows;
      const double angle = 2 * std::numbers::pi * along / sectors;
      const double radius = 1 + 0.1 * std::sin(3 * angle) * across;
      mesh.positions.emplace_back(Vec3d(radius * std::cos(angle), radius * std::sin(angle), across));
      map.phi.push_back(on_band(sectors, std::llround(along * static_cast<double>(kLatticeOne)),
                                std::llround(across * static_cast<double>(kLatticeOne))));
    }
  }
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < columns; ++c) {
      const int next = (c + 1) % columns;
      const int a = r * columns;
      const int b = a + columns;
      mesh.triangles.push_back({a + c, a + next, b + c});
      mesh.triangles.push_back({a + next, b + next, b + c});
    }
  }
  return named("annulus_" + std::to_string(sectors) + "_" + std::to_string(columns), {mesh, map}, 2, 0);
}

OpenSurface open_and_closed(int n) {
  OpenSurface both = hemisphere(n);
  const auto [ball, map] = subdivided_sphere(octahedron(), n);
  const auto vertices = static_cast<VertexId>(both.mesh.positions.size());
  const DomainTriangleId triangles = both.map.domain.size();
  for (std::size_t v = 0; v < ball.positions.size(); ++v) {
    both.mesh.positions.push_back(ball.positions[v] * 0.75F + Vec3f(2.5F, 0.25F, 0.125F));
    both.map.phi.push_back(map.phi[v]);
    both.map.phi.back().triangle += triangles;
  }
  for (const auto& [a, b, c] : ball.triangles)
    both.mesh.triangles.push_back({a + vertices, b + vertices, c + vertices});
  for (DomainTriangle t : map.domain.triangles) {
    for (DomainVertex& v : t.corners) v += both.map.domain.vertex_count;
    for (DomainSide& side : t.neighbours) side.triangle += triangles;
    both.map.domain.triangles.push_back(t);
  }
  both.map.domain.vertex_count += map.domain.vertex_count;
  both.name = both.mesh.scene_name = "open_and_closed";
  both.mesh.origin = both.name + ".glb";
  both.euler = 3;
  return both;
}

OpenSurface two_scales(int n) {
  OpenSurface both = open_and_closed(n);
  const auto [first, count] = std::pair(hemisphere(n).map.domain.size(), both.map.domain.size());
  for (DomainTriangleId t = 0; t < count; ++t) both.map.first_levels.push_back(t < first ? 0 : 2);
  both.name = both.mesh.scene_name = "two_scales";
  both.mesh.origin = both.name + ".glb";
  return both;
}

std::vector<OpenSurface> open_surfaces() {
  std::vector<OpenSurface> all;
  for (const int n : {1, 5}) {
    for (OpenSurface surface : {triangle(n), hemisphere(n), bowl(n), open_and_closed(n), two_scales(n), fan(1, n),
                                fan(2, n), fan(3, n), fan(4, n), fan(5, n), fan(7, n)}) {
      jitter(surface.map, 0.2 / n, static_cast<unsigned>(n));
      all.push_back(std::move(surface));
    }
  }
  // Source edges as long as domain sides, around the domain's vertices; then short ones.
  all.push_back(annulus(4, 4, 1, 0.5));
  all.push_back(annulus(3, 3, 1, 0.01));
  all.push_back(annulus(5, 17, 4, 0.375));
  return all;
}

double boundary_distance(const SurfaceView& from, const SurfaceView& to) {
  const std::vector<BoundarySide> sides = boundary_sides(to);
  double farthest = 0;
  for (const BoundarySide& side : boundary_sides(from)) {
    const Vec3d p(from.positions[side[0]]);
    double nearest = std::numeric_limits<double>::infinity();
    for (const auto& [a, b] : sides) {
      const Vec3d start(to.positions[a]);
      const Vec3d along = Vec3d(to.positions[b]) - start;
      const double share = std::clamp((p - start).dot(along) / along.dot(along), 0.0, 1.0);
      nearest = std::min(nearest, (p - start - along * share).length());
    }
    farthest = std::max(farthest, nearest);
  }
  return farthest;
}

}  // namespace lozenge::fixtures
