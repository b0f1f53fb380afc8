// Marching tetrahedra. A cube cut into six tetrahedra along its diagonal meets its neighbours' tetrahedra face to face,
// so the zero set of the field's linear interpolation is a closed manifold, whatever the field. Its slivers are then
// smoothed away: every vertex moves to the mean of its neighbours and back to the surface along the field's gradient.

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>
#include <utility>

#include "test_assets/shape.h"

namespace lozenge::test_assets {
namespace {

using Field = std::function<double(const Vec3d&)>;

struct Grid {
  Vec3d low;
  double cell = 0;
  std::array<std::int64_t, 3> size{};  ///< in cells
  std::vector<double> values;          ///< [grid point]

  std::int64_t index(std::int64_t x, std::int64_t y, std::int64_t z) const {
    return (z * (size[1] + 1) + y) * (size[0] + 1) + x;
  }
  Vec3d point(std::int64_t index) const {
    const std::int64_t x = index % (size[0] + 1);
    const std::int64_t y = index / (size[0] + 1) % (size[1] + 1);
    const std::int64_t z = index / ((size[0] + 1) * (size[1] + 1));
    return low + cell * Vec3d(double(x), double(y), double(z));
  }
};

Grid sampled(const Field& field, const Vec3d& low, const Vec3d& high, double cell) {
  Grid grid;
  grid.low = low;
  grid.cell = cell;
  for (int axis = 0; axis < 3; ++axis) grid.size[axis] = std::llround(std::ceil((high[axis] - low[axis]) / cell));
  const std::int64_t count = (grid.size[0] + 1) * (grid.size[1] + 1) * (grid.size[2] + 1);
  grid.values.reserve(count);
  for (std::int64_t i = 0; i < count; ++i) grid.values.push_back(field(grid.point(i)));
  return grid;
}

/// The surface while it grows, one tetrahedron after the other.
struct Marcher {
  const Grid& grid;
  Shape shape;
  std::vector<Vec3d> places;                                 ///< [vertex]
  std::unordered_map<std::int64_t, std::int32_t> crossings;  ///< [grid edge] its vertex

  bool inside(std::int64_t p) const { return grid.values[p] < 0; }

  /// The vertex where the surface crosses the grid edge; kept away from its ends, so that no two coincide.
  std::int32_t crossing(std::int64_t a, std::int64_t b) {
    if (a > b) std::swap(a, b);
    const std::int64_t key = a * static_cast<std::int64_t>(grid.values.size()) + b;
    const auto [found, is_new] = crossings.try_emplace(key, static_cast<std::int32_t>(places.size()));
    if (is_new) {
      const double t = grid.values[a] / (grid.values[a] - grid.values[b]);
      const double kept = std::clamp(t, 0.05, 0.95);
      places.push_back(grid.point(a) * (1 - kept) + grid.point(b) * kept);
    }
    return found->second;
  }

  void triangle(std::int32_t a, std::int32_t b, std::int32_t c) { shape.triangles.push_back({a, b, c}); }

  /// \pre the corners are ordered so that the tetrahedron's volume is positive
  void tetrahedron(std::array<std::int64_t, 4> p) {
    // Even permutations bring the corners inside to the front.
    int count = 0;
    for (const std::int64_t corner : p) count += inside(corner) ? 1 : 0;
    if (count == 0 || count == 4) return;
    static constexpr std::array<std::array<int, 4>, 12> kEven{{{0, 1, 2, 3},
                                                               {0, 2, 3, 1},
                                                               {0, 3, 1, 2},
                                                               {1, 0, 3, 2},
                                                               {1, 3, 2, 0},
                                                               {1, 2, 0, 3},
                                                               {2, 0, 1, 3},
                                                               {2, 1, 3, 0},
                                                               {2, 3, 0, 1},
                                                               {3, 0, 2, 1},
                                                               {3, 2, 1, 0},
                                                               {3, 1, 0, 2}}};
    for (const auto& order : kEven) {
      const std::array<std::int64_t, 4> q{p[order[0]], p[order[1]], p[order[2]], p[order[3]]};
      int front = 0;
      while (front < 4 && inside(q[front])) ++front;
      if (front == count) return cut(q, count);
    }
  }

  void cut(const std::array<std::int64_t, 4>& q, int count) {
    if (count == 1) triangle(crossing(q[0], q[1]), crossing(q[0], q[2]), crossing(q[0], q[3]));
    if (count == 3) triangle(crossing(q[3], q[0]), crossing(q[3], q[1]), crossing(q[3], q[2]));
    if (count == 2) {
      const std::int32_t a = crossing(q[0], q[2]);
      const std::int32_t b = crossing(q[0], q[3]);
      const std::int32_t c = crossing(q[1], q[3]);
      const std::int32_t d = crossing(q[1], q[2]);
      triangle(a, b, c);
      triangle(a, c, d);
    }
  }
};

/// The six tetrahedra of a cube: one for each order in which the axes lead from its low corner to its high one.
void march_cube(Marcher& marcher, std::int64_t x, std::int64_t y, std::int64_t z) {
  static constexpr std::array<std::array<int, 3>, 6> kOrders{
      {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};
  for (std::size_t o = 0; o < kOrders.size(); ++o) {
    std::array<std::int64_t, 3> at{x, y, z};
    std::array<std::int64_t, 4> corners{marcher.grid.index(x, y, z)};
    for (int step = 0; step < 3; ++step) {
      ++at[kOrders[o][step]];
      corners[step + 1] = marcher.grid.index(at[0], at[1], at[2]);
    }
    if (o >= 3) std::swap(corners[1], corners[2]);  // odd orders turn the other way round
    marcher.tetrahedron(corners);
  }
}

Vec3d gradient(const Field& field, const Vec3d& p, double step) {
  const Vec3d x(step, 0, 0);
  const Vec3d y(0, step, 0);
  const Vec3d z(0, 0, step);
  return Vec3d(field(p + x) - field(p - x), field(p + y) - field(p - y), field(p + z) - field(p - z)) / (2 * step);
}

/// One Newton step towards the surface, at most half a cell long.
Vec3d projected(const Field& field, const Vec3d& p, double cell) {
  const Vec3d slope = gradient(field, p, 0.01 * cell);
  const double steepness = slope.length2();
  if (steepness == 0) return p;
  Vec3d move = slope * (-field(p) / steepness);
  const double length = move.length();
  if (length > 0.5 * cell) move *= 0.5 * cell / length;
  return p + move;
}

/// Every vertex goes to the mean of its neighbours, within the plane across its normal, and back to the surface.
void smooth(std::vector<Vec3d>& places, const Shape& shape, const Field& field, double cell) {
  std::vector<Vec3d> sums(places.size(), Vec3d(0, 0, 0));
  std::vector<Vec3d> normals(places.size(), Vec3d(0, 0, 0));
  std::vector<double> counts(places.size(), 0);
  for (const auto& t : shape.triangles) {
    const Vec3d normal = (places[t[1]] - places[t[0]]).cross(places[t[2]] - places[t[0]]);
    for (int k = 0; k < 3; ++k) {
      sums[t[k]] += places[t[(k + 1) % 3]];
      normals[t[k]] += normal;
      counts[t[k]] += 1;
    }
  }
  for (std::size_t v = 0; v < places.size(); ++v) {
    const Vec3d normal = normals[v].normalized();
    Vec3d move = sums[v] / counts[v] - places[v];
    move -= normal * move.dot(normal);
    places[v] = projected(field, places[v] + 0.7 * move, cell);
  }
}

}  // namespace

Shape implicit_surface(const Field& field, const Vec3d& low, const Vec3d& high, double cell, int rounds) {
  const Grid grid = sampled(field, low, high, cell);
  Marcher marcher{grid, {}, {}, {}};
  for (std::int64_t z = 0; z < grid.size[2]; ++z) {
    for (std::int64_t y = 0; y < grid.size[1]; ++y) {
      for (std::int64_t x = 0; x < grid.size[0]; ++x) march_cube(marcher, x, y, z);
    }
  }
  Shape shape = std::move(marcher.shape);
  for (int round = 0; round < rounds; ++round) smooth(marcher.places, shape, field, cell);
  for (Vec3d& place : marcher.places) place = projected(field, projected(field, place, cell), cell);
  for (const Vec3d& place : marcher.places) shape.positions.emplace_back(place);
  return shape;
}

}  // namespace lozenge::test_assets
