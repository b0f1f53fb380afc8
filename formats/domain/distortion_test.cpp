#include "formats/domain/distortion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include <Imath/ImathMatrix.h>
#include <Imath/ImathMatrixAlgo.h>

#include "formats/domain/sphere_fixtures.h"

namespace lozenge {
namespace {

/// The domain's own subdivision with its corners at these places in space: an isometry where all of its triangles are
/// equilateral and of one size.
std::pair<SourceMesh, Parameterization> flat_faced(const Domain& base, const std::vector<Vec3d>& corners, int n) {
  auto [mesh, map] = fixtures::subdivided_sphere(base, n);
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const DomainPoint& p = map.phi[v];
    const auto& c = base.triangles[p.triangle].corners;
    mesh.positions[v] = Vec3f(corners[c[0]] * p.alpha + corners[c[1]] * p.beta + corners[c[2]] * p.gamma());
  }
  return {mesh, map};
}

std::pair<SourceMesh, Parameterization> flat_octahedron(int n) {
  return flat_faced(fixtures::octahedron(), {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}, n);
}
std::pair<SourceMesh, Parameterization> flat_tetrahedron(int n) {
  return flat_faced(fixtures::tetrahedron(), {{1, 1, 1}, {-1, -1, 1}, {-1, 1, -1}, {1, -1, -1}}, n);
}

TEST(Distortion, IsZeroForAnIsometry) {
  for (const int n : {1, 2, 5, 16}) {
    for (const auto& [mesh, map] : {flat_octahedron(n), flat_tetrahedron(n)}) {
      const Distortion d = measure_distortion(mesh, map);
      // Positions are floats: relative errors of 1e-7 times the subdivision enter squared, except for the stretch.
      EXPECT_NEAR(d.area, 0, 1e-9);
      EXPECT_NEAR(d.angle, 0, 1e-9);
      EXPECT_NEAR(d.aggregate, 0, 1e-9);
      EXPECT_NEAR(d.l2_stretch, 1, 1e-6);
      EXPECT_EQ(d.folded_triangles, 0);
      EXPECT_EQ(d.area_sum_error, 0);
    }
  }
}

TEST(Distortion, DoesNotChangeWhenTheSurfaceIsMovedTurnedOrScaled) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> number(-1, 1);
  for (int i = 0; i < 20; ++i) {
    auto [mesh, map] = fixtures::subdivided_sphere(fixtures::icosahedron(), 6);
    fixtures::jitter(map, 0.05, static_cast<unsigned>(i));
    const Distortion before = measure_distortion(mesh, map);
    Imath::M44d motion;
    motion.translate(Vec3d(number(random), number(random), number(random)));
    motion.rotate(Vec3d(3 * number(random), 3 * number(random), 3 * number(random)));
    motion.scale(Vec3d(std::exp(2 * number(random))));
    for (Vec3f& p : mesh.positions) {
      Vec3d moved;
      motion.multVecMatrix(Vec3d(p), moved);
      p = Vec3f(moved);
    }
    const Distortion after = measure_distortion(mesh, map);
    EXPECT_NEAR(after.area, before.area, 1e-5);
    EXPECT_NEAR(after.angle, before.angle, 1e-5);
    EXPECT_NEAR(after.l2_stretch, before.l2_stretch, 1e-5);
    EXPECT_EQ(after.folded_triangles, before.folded_triangles);
  }
}

TEST(Distortion, IsPositiveForWhatIsNoIsometry) {
  for (const Domain& base : {fixtures::tetrahedron(), fixtures::octahedron(), fixtures::icosahedron()}) {
    const auto [mesh, map] = fixtures::subdivided_sphere(base, 8);
    const Distortion d = measure_distortion(mesh, map);
    EXPECT_GT(d.area, 1e-3);
    EXPECT_GT(d.angle, 1e-4);
    EXPECT_GT(d.l2_stretch, 1.001);
    EXPECT_NEAR(d.aggregate, std::pow(std::pow(1 + d.area, 3) * (1 + d.angle), 0.25) - 1, 1e-12);
  }
}

TEST(Distortion, HasTheValuesOfAStretchAlongOneAxis) {
  // A flat square torus has no place in space, so a square of two triangles stands in: an open domain, stretched by s
  // along its first side. Then every image has the same share of the area, s1 / s2 = s, and the stretch is ((s + 1 / s)
  // / 2)^(1/2).
  const Domain rhombus = make_domain({{0, 1, 2}, {1, 3, 2}}, 4);
  const Parameterization map{rhombus, {{0, 1, 0}, {0, 0, 1}, {0, 0, 0}, {1, 0, 1}}};
  for (const double s : {1.0, 1.5, 2.0, 8.0}) {
    SourceMesh mesh;
    const double h = std::sqrt(3.0) / 2;
    for (const Vec2d& p : {Vec2d(0, 0), Vec2d(1, 0), Vec2d(0.5, h), Vec2d(1.5, h)})
      mesh.positions.push_back(Vec3f(Vec3d(s * p.x, p.y, 0)));
    mesh.triangles = {{0, 1, 2}, {1, 3, 2}};
    const Distortion d = measure_distortion(mesh, map);
    EXPECT_NEAR(d.area, 0, 1e-6);
    EXPECT_NEAR(d.angle, (s + 1 / s) / 2 - 1, 1e-6);
    EXPECT_NEAR(d.l2_stretch, std::sqrt((s + 1 / s) / 2), 1e-6);
  }
}

/// The second surface and its domain beside the first, each with a scale of its own.
std::pair<SourceMesh, Parameterization> beside(std::pair<SourceMesh, Parameterization> both,
                                               const std::pair<SourceMesh, Parameterization>& other, double size,
                                               std::int32_t first_level) {
  auto& [mesh, map] = both;
  map.first_levels.assign(map.domain.triangles.size(), 0);
  const auto first = static_cast<VertexId>(mesh.positions.size());
  const DomainTriangleId shift = map.domain.size();
  for (const Vec3f& p : other.first.positions) mesh.positions.push_back(p * static_cast<float>(size) + Vec3f(9, 0, 0));
  for (const auto& t : other.first.triangles) mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  for (DomainTriangle t : other.second.domain.triangles) {
    for (DomainVertex& n : t.corners) n += map.domain.vertex_count;
    for (DomainSide& side : t.neighbours) side.triangle += shift;
    map.domain.triangles.push_back(t);
    map.first_levels.push_back(first_level);
  }
  map.domain.vertex_count += other.second.domain.vertex_count;
  for (DomainPoint p : other.second.phi) {
    p.triangle += shift;
    map.phi.push_back(p);
  }
  return both;
}

TEST(Distortion, IsZeroForIsometriesOfPartsEachAtItsOwnScale) {
  for (const std::int32_t level : {0, 1, 2, 3, 5}) {
    const double size = 1.0 / (1 << level);
    const auto [mesh, map] = beside(flat_octahedron(4), flat_octahedron(5), size, level);
    const Distortion d = measure_distortion(mesh, map);
    EXPECT_NEAR(d.area, 0, 1e-7) << level;
    EXPECT_NEAR(d.angle, 0, 1e-7);
    EXPECT_NEAR(d.l2_stretch, 1, 1e-5);
    EXPECT_EQ(d.folded_triangles, 0);
    EXPECT_EQ(d.area_sum_error, 0);
    EXPECT_NEAR(scaled_size(map), 8 + 8 * size * size, 1e-12);
  }
}

TEST(Distortion, CountsAScaleThatDoesNotFit) {
  // Both have the same area, but the second half the scale: its image has a fifth of the whole.
  const auto [mesh, map] = beside(flat_octahedron(4), flat_octahedron(4), 1, 1);
  const Distortion d = measure_distortion(mesh, map);
  EXPECT_NEAR(d.area, 0.5 * ((0.5 / 0.8 + 0.8 / 0.5) / 2 - 1) + 0.5 * ((0.5 / 0.2 + 0.2 / 0.5) / 2 - 1), 1e-6);
  EXPECT_NEAR(d.angle, 0, 1e-7);
}

TEST(Distortion, FindsAFoldAtAnyVertex) {
  std::mt19937 random(4);
  for (int i = 0; i < 50; ++i) {
    auto [mesh, map] = flat_octahedron(6);
    // An interior vertex moved beyond a corner's neighbourhood turns some of its triangles over.
    DomainPoint* p = nullptr;
    while (p == nullptr || p->alpha == 0 || p->beta == 0 || p->gamma() == 0) p = &map.phi[random() % map.phi.size()];
    const int far = p->alpha > 0.4 ? 1 : 0;
    *p = far == 1 ? make_point(p->triangle, 0.02, 0.96) : make_point(p->triangle, 0.96, 0.02);
    const Distortion d = measure_distortion(mesh, map);
    EXPECT_GT(d.folded_triangles, 0);
    EXPECT_EQ(d.area_sum_error, 0) << "signed areas still add up: the vertex is inside its face";
  }
}

TEST(Distortion, CountsImagesOfNoArea) {
  auto [mesh, map] = flat_octahedron(4);
  const auto& [a, b, c] = mesh.triangles[0];
  map.phi[b] = map.phi[a];
  EXPECT_GT(measure_distortion(mesh, map).folded_triangles, 0);
}

TEST(SingularValues, AreThoseOfTheMatrixThatMovesTheTriangle) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> number(-2, 2);
  for (int i = 0; i < 500; ++i) {
    // The map is U diag(s1, s2) V with rotations U, V.
    const double s2 = std::exp(number(random));
    const double s1 = s2 * (1 + std::abs(number(random)));
    const double v = number(random);
    Imath::M44d turn;
    turn.rotate(Vec3d(number(random), number(random), number(random)));
    const std::array<Vec2d, 3> plane{Vec2d(number(random), number(random)), Vec2d(number(random), number(random)),
                                     Vec2d(number(random), number(random))};
    const Vec2d e = plane[1] - plane[0];
    const Vec2d f = plane[2] - plane[0];
    if (std::abs(e.x * f.y - e.y * f.x) < 0.05) continue;
    std::array<Vec3d, 3> space;
    for (int k = 0; k < 3; ++k) {
      const Vec2d p(std::cos(v) * plane[k].x - std::sin(v) * plane[k].y,
                    std::sin(v) * plane[k].x + std::cos(v) * plane[k].y);
      turn.multVecMatrix(Vec3d(s1 * p.x, s2 * p.y, 0), space[k]);
    }
    const SingularValues s = singular_values(plane, space);
    EXPECT_NEAR(s.s1, s1, 1e-8 * s1);
    EXPECT_NEAR(s.s2, s2, 1e-8 * s1);
  }
}

TEST(SingularValues, AreInfiniteForAPlaneTriangleOfNoArea) {
  const SingularValues s =
      singular_values({Vec2d(0, 0), Vec2d(1, 1), Vec2d(2, 2)}, {Vec3d(0, 0, 0), Vec3d(1, 0, 0), Vec3d(0, 1, 0)});
  EXPECT_TRUE(std::isinf(s.s1));
}

}  // namespace
}  // namespace lozenge
