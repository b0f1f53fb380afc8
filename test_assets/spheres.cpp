// Spheres from subdivided polyhedra.

#include <cmath>
#include <map>
#include <utility>

#include "test_assets/shape.h"

namespace lozenge::test_assets {
namespace {

/// Vertex in the middle of an edge, pushed out to the unit sphere; one for both triangles beside it.
class Midpoints {
 public:
  explicit Midpoints(std::vector<Vec3f>& positions) : positions_(positions) {}

  std::int32_t between(std::int32_t a, std::int32_t b) {
    const auto [found, is_new] = known_.try_emplace(std::minmax(a, b), static_cast<std::int32_t>(positions_.size()));
    if (is_new) positions_.emplace_back((Vec3d(positions_[a]) + Vec3d(positions_[b])).normalized());
    return found->second;
  }

 private:
  std::vector<Vec3f>& positions_;
  std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> known_;
};

Shape subdivided(Shape shape, int times) {
  for (int round = 0; round < times; ++round) {
    Midpoints midpoints(shape.positions);
    std::vector<std::array<std::int32_t, 3>> finer;
    for (const auto& [a, b, c] : shape.triangles) {
      const std::int32_t ab = midpoints.between(a, b);
      const std::int32_t bc = midpoints.between(b, c);
      const std::int32_t ca = midpoints.between(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    shape.triangles = std::move(finer);
  }
  return shape;
}

}  // namespace

Shape icosphere(int times) {
  const double golden = (1 + std::sqrt(5.0)) / 2;
  Shape shape;
  for (const Vec3d& corner : {Vec3d(-1, golden, 0), Vec3d(1, golden, 0), Vec3d(-1, -golden, 0), Vec3d(1, -golden, 0),
                              Vec3d(0, -1, golden), Vec3d(0, 1, golden), Vec3d(0, -1, -golden), Vec3d(0, 1, -golden),
                              Vec3d(golden, 0, -1), Vec3d(golden, 0, 1), Vec3d(-golden, 0, -1), Vec3d(-golden, 0, 1)}) {
    shape.positions.emplace_back(corner.normalized());
  }
  shape.triangles = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                     {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                     {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  return subdivided(std::move(shape), times);
}

Shape octasphere(int times) {
  Shape shape;
  shape.positions = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  shape.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  return subdivided(std::move(shape), times);
}

Shape bumpy_sphere() {
  Shape shape = octasphere(5);
  for (Vec3f& p : shape.positions) {
    const Vec3d d(p);
    const double broad = std::sin(3 * d.x + 1) * std::sin(4 * d.y) * std::cos(3 * d.z);
    const double fine = std::sin(9 * d.x) * std::sin(9 * d.y + 1) * std::sin(9 * d.z + 2);
    p = Vec3f(d * (1 + 0.3 * broad + 0.08 * fine));
  }
  return shape;
}

}  // namespace lozenge::test_assets
