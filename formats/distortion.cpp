#include "formats/distortion.h"

#include <cmath>
#include <limits>

namespace lozenge {

std::optional<Development> image_of(const SourceMesh& mesh, const Parameterization& map, TriangleId t) {
  const auto& [a, b, c] = mesh.triangles[t];
  return develop(map.domain, {map.phi[a], map.phi[b], map.phi[c]});
}

SingularValues singular_values(const std::array<Vec2d, 3>& plane, const std::array<Vec3d, 3>& space) {
  const Vec2d e = plane[1] - plane[0];
  const Vec2d f = plane[2] - plane[0];
  const Vec3d p = space[1] - space[0];
  const Vec3d q = space[2] - space[0];
  const double det = e.x * f.y - e.y * f.x;
  // Columns of the Jacobian: images of the plane's axes.
  const Vec3d x = (p * f.y - q * e.y) / det;
  const Vec3d y = (q * e.x - p * f.x) / det;
  const double a = x.dot(x);
  const double b = x.dot(y);
  const double c = y.dot(y);
  const double mean = (a + c) / 2;
  const double spread = std::sqrt((a - c) * (a - c) / 4 + b * b);
  if (!std::isfinite(mean + spread)) {
    return {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  }
  const double s1 = std::sqrt(mean + spread);
  // The product of both is the ratio of the areas, which is better conditioned than mean - spread.
  const double area_ratio = p.cross(q).length() / std::abs(det);
  return {s1, s1 > 0 ? area_ratio / s1 : 0};
}

Distortion measure_distortion(const SourceMesh& mesh, const Parameterization& map) {
  double surface_area = 0;
  std::vector<double> areas(mesh.triangles.size());
  for (std::size_t t = 0; t < areas.size(); ++t) {
    areas[t] = triangle_area(mesh.positions, mesh.triangles[t]);
    surface_area += areas[t];
  }
  const double unit_area = std::sqrt(3.0) / 4;
  const double domain_area = map.domain.size() * unit_area;

  Distortion result;
  result.l2_stretch = 0;
  LatticeArea image_sum = 0;
  for (std::size_t t = 0; t < areas.size(); ++t) {
    const auto image = image_of(mesh, map, static_cast<TriangleId>(t));
    const LatticeArea doubled = image ? doubled_area(image->corners[0], image->corners[1], image->corners[2]) : 0;
    image_sum += doubled;
    if (doubled <= 0) {
      ++result.folded_triangles;
      continue;
    }
    if (areas[t] <= 0) continue;
    const auto& [a, b, c] = mesh.triangles[t];
    const auto s = singular_values(
        {plane_point(image->corners[0]), plane_point(image->corners[1]), plane_point(image->corners[2])},
        {Vec3d(mesh.positions[a]), Vec3d(mesh.positions[b]), Vec3d(mesh.positions[c])});
    const double share = areas[t] / surface_area;
    const double image_share =
        static_cast<double>(doubled) / static_cast<double>(kUnitTriangleDoubledArea) / map.domain.size();
    result.area += share * ((share / image_share + image_share / share) / 2 - 1);
    result.angle += share * ((s.s1 / s.s2 + s.s2 / s.s1) / 2);
    result.l2_stretch += share * (s.s1 * s.s1 + s.s2 * s.s2) / 2;
  }
  result.angle -= 1;
  result.aggregate = std::pow(std::pow(1 + result.area, 3) * (1 + result.angle), 0.25) - 1;
  result.l2_stretch = std::sqrt(result.l2_stretch * domain_area / surface_area);
  const LatticeArea excess = image_sum - kUnitTriangleDoubledArea * map.domain.size();
  result.area_sum_error =
      std::abs(static_cast<double>(excess)) / (static_cast<double>(kUnitTriangleDoubledArea) * map.domain.size());
  return result;
}

}  // namespace lozenge
