// Closed tubes: a ring, and a trefoil.

#include <cmath>
#include <numbers>

#include "test_assets/shape.h"

namespace lozenge::test_assets {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

Vec3d trefoil(double t) {
  return {std::sin(t) + 2 * std::sin(2 * t), std::cos(t) - 2 * std::cos(2 * t), -std::sin(3 * t)};
}
Vec3d trefoil_velocity(double t) {
  return {std::cos(t) + 4 * std::cos(2 * t), -std::sin(t) + 4 * std::sin(2 * t), -3 * std::cos(3 * t)};
}
Vec3d trefoil_acceleration(double t) {
  return {-std::sin(t) - 8 * std::sin(2 * t), -std::cos(t) + 8 * std::cos(2 * t), 9 * std::sin(3 * t)};
}

}  // namespace

Shape torus(double ring_radius, double tube_radius, int nu, int nv) {
  return closed_grid(nu, nv, [=](double u, double v) {
    const double out = ring_radius + tube_radius * std::cos(kTurn * v);
    return Vec3d(out * std::cos(kTurn * u), out * std::sin(kTurn * u), tube_radius * std::sin(kTurn * v));
  });
}

Shape knot() {
  // The curvature of this trefoil vanishes nowhere, so its Frenet frame closes by itself.
  return closed_grid(240, 20, [](double u, double v) {
    const double t = kTurn * u;
    const Vec3d tangent = trefoil_velocity(t).normalized();
    const Vec3d binormal = trefoil_velocity(t).cross(trefoil_acceleration(t)).normalized();
    const Vec3d normal = binormal.cross(tangent);
    const double radius = 0.45 + 0.05 * std::cos(3 * t);
    return trefoil(t) + radius * (std::cos(kTurn * v) * normal - std::sin(kTurn * v) * binormal);
  });
}

}  // namespace lozenge::test_assets
