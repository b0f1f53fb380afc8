// Surfaces that end somewhere.

#include <algorithm>
#include <cmath>
#include <numbers>

#include "test_assets/shape.h"

namespace lozenge::test_assets {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

/// A grid of nu x nv quads over u, v in [0, 1], which may close in u.
Shape open_grid(int nu, int nv, bool close_u, const std::function<Vec3d(double, double)>& place) {
  Shape shape;
  const int columns = close_u ? nu : nu + 1;
  for (int v = 0; v <= nv; ++v) {
    for (int u = 0; u < columns; ++u) shape.positions.emplace_back(place(double(u) / nu, double(v) / nv));
  }
  const auto at = [&](int u, int v) { return v * columns + u % columns; };
  for (int v = 0; v < nv; ++v) {
    for (int u = 0; u < nu; ++u) {
      shape.triangles.push_back({at(u, v), at(u + 1, v), at(u, v + 1)});
      shape.triangles.push_back({at(u + 1, v), at(u + 1, v + 1), at(u, v + 1)});
    }
  }
  return shape;
}

/// Leaves out the vertices that no triangle uses.
void drop_unused_vertices(Shape& shape) {
  std::vector<std::int32_t> number(shape.positions.size(), -1);
  std::vector<Vec3f> kept;
  for (auto& triangle : shape.triangles) {
    for (std::int32_t& v : triangle) {
      if (number[v] < 0) {
        number[v] = static_cast<std::int32_t>(kept.size());
        kept.push_back(shape.positions[v]);
      }
      v = number[v];
    }
  }
  shape.positions = std::move(kept);
}

}  // namespace

Shape disk(int rings) {
  Shape shape;
  shape.positions.emplace_back(0, 0, 0);
  // Ring r has 6 r vertices; those of the rings inside come first.
  const auto at = [](int ring, int k) { return ring == 0 ? 0 : 1 + 3 * ring * (ring - 1) + k % (6 * ring); };
  for (int r = 1; r <= rings; ++r) {
    for (int k = 0; k < 6 * r; ++k) {
      const double angle = kTurn * k / (6 * r);
      shape.positions.emplace_back(Vec3d(std::cos(angle), std::sin(angle), 0) * (double(r) / rings));
    }
    for (int sixth = 0; sixth < 6; ++sixth) {
      const int outer = sixth * r;
      const int inner = sixth * (r - 1);
      for (int k = 0; k < r; ++k) {
        shape.triangles.push_back({at(r, outer + k), at(r, outer + k + 1), at(r - 1, inner + k)});
        if (k + 1 == r) continue;
        shape.triangles.push_back({at(r - 1, inner + k), at(r, outer + k + 1), at(r - 1, inner + k + 1)});
      }
    }
  }
  return shape;
}

Shape annulus(int nu, int nv) {
  return open_grid(nu, nv, true, [](double u, double v) {
    return Vec3d(std::cos(kTurn * u), std::sin(kTurn * u), 0) * (1 - 0.5 * v);
  });
}

Shape hemisphere(int times) {
  Shape shape = octasphere(times);
  std::erase_if(shape.triangles, [&](const auto& triangle) {
    return std::any_of(triangle.begin(), triangle.end(), [&](std::int32_t v) { return shape.positions[v].z < 0; });
  });
  drop_unused_vertices(shape);
  return shape;
}

Shape plane(int nu, int nv) {
  return open_grid(nu, nv, false, [=](double u, double v) { return Vec3d(u * nu / nv, v, 0); });
}

Shape single_triangle() { return {{{0, 0, 0}, {1, 0, 0}, {0.25F, 0.75F, 0.5F}}, {{0, 1, 2}}}; }

}  // namespace lozenge::test_assets
