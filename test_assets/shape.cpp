#include "test_assets/shape.h"

namespace lozenge::test_assets {

Shape closed_grid(int nu, int nv, const std::function<Vec3d(double, double)>& place) {
  Shape shape;
  for (int v = 0; v < nv; ++v) {
    for (int u = 0; u < nu; ++u) shape.positions.emplace_back(place(double(u) / nu, double(v) / nv));
  }
  const auto at = [&](int u, int v) { return (v % nv) * nu + u % nu; };
  for (int v = 0; v < nv; ++v) {
    for (int u = 0; u < nu; ++u) {
      shape.triangles.push_back({at(u, v), at(u + 1, v), at(u, v + 1)});
      shape.triangles.push_back({at(u + 1, v), at(u + 1, v + 1), at(u, v + 1)});
    }
  }
  return shape;
}

std::vector<Vec3f> smooth_normals(const Shape& shape) {
  std::vector<Vec3d> sums(shape.positions.size(), Vec3d(0, 0, 0));
  for (const auto& [a, b, c] : shape.triangles) {
    const Vec3d origin(shape.positions[a]);
    const Vec3d normal = (Vec3d(shape.positions[b]) - origin).cross(Vec3d(shape.positions[c]) - origin);
    for (const int corner : {a, b, c}) sums[corner] += normal;
  }
  std::vector<Vec3f> normals;
  for (const Vec3d& sum : sums) normals.emplace_back(sum.normalized());
  return normals;
}

double signed_volume(const Shape& shape) {
  double volume = 0;
  for (const auto& [a, b, c] : shape.triangles) {
    volume += Vec3d(shape.positions[a]).dot(Vec3d(shape.positions[b]).cross(Vec3d(shape.positions[c])));
  }
  return volume;
}

}  // namespace lozenge::test_assets
