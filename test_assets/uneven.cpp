// A closed surface that is hard on whatever expects triangles of similar size and shape.

#include <cmath>
#include <numbers>

#include "test_assets/shape.h"

namespace lozenge::test_assets {
namespace {

constexpr int kSegments = 96;

/// Radius and height of the rings, from the bottom up: a long plain wall, then steps that shrink by a third each time.
std::vector<Vec2d> profile() {
  std::vector<Vec2d> rings{{1, 0}, {1, 4}, {0.55, 4.1}, {0.5, 7}};
  double step = 0.5;
  for (int k = 0; k < 24; ++k) {
    const Vec2d last = rings.back();
    rings.push_back(last + Vec2d(k % 2 == 0 ? 0.6 * step : -0.5 * step, step));
    step *= 0.75;
  }
  return rings;
}

/// Splits the triangle in three at its centroid.
void split(Shape& shape, std::size_t t) {
  const auto [a, b, c] = shape.triangles[t];
  const auto centre = static_cast<std::int32_t>(shape.positions.size());
  shape.positions.emplace_back((Vec3d(shape.positions[a]) + Vec3d(shape.positions[b]) + Vec3d(shape.positions[c])) /
                               3.0);
  shape.triangles[t] = {a, b, centre};
  shape.triangles.push_back({b, c, centre});
  shape.triangles.push_back({c, a, centre});
}

}  // namespace

Shape uneven() {
  Shape shape;
  const std::vector<Vec2d> rings = profile();
  for (const Vec2d& ring : rings) {
    for (int s = 0; s < kSegments; ++s) {
      const double angle = 2 * std::numbers::pi * s / kSegments;
      shape.positions.emplace_back(Vec3d(ring.x * std::cos(angle), ring.y, -ring.x * std::sin(angle)));
    }
  }
  const auto at = [&](std::size_t ring, int s) { return static_cast<std::int32_t>(ring) * kSegments + s % kSegments; };
  const auto bottom = static_cast<std::int32_t>(shape.positions.size());
  shape.positions.emplace_back(Vec3d(0, rings.front().y, 0));
  shape.positions.emplace_back(Vec3d(0, rings.back().y, 0));
  for (int s = 0; s < kSegments; ++s) {
    shape.triangles.push_back({bottom, at(0, s + 1), at(0, s)});
    for (std::size_t r = 0; r + 1 < rings.size(); ++r) {
      shape.triangles.push_back({at(r, s), at(r, s + 1), at(r + 1, s)});
      shape.triangles.push_back({at(r, s + 1), at(r + 1, s + 1), at(r + 1, s)});
    }
    shape.triangles.push_back({bottom + 1, at(rings.size() - 1, s), at(rings.size() - 1, s + 1)});
  }
  // Splitting the same triangle over and over makes its corner's neighbours shrink by three each time.
  for (std::size_t k = 0; k < 120; ++k) {
    const std::size_t t = k * 37;
    for (int again = 0; again < 5; ++again) split(shape, t);
  }
  return shape;
}

}  // namespace lozenge::test_assets
