// Each triangle's Jacobian maps its flat image (development.h) to space: areas and singular values follow from it, and
// sums are taken in parts whose order is fixed. Image areas are integers, so that folds and gaps are counted, not
// estimated.
#include "formats/domain/distortion.h"

#include <cmath>
#include <limits>

#include "formats/base/parallel.h"

namespace lozenge {

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

double aggregate_of(double d_a, double d_c) {
  return std::pow(std::pow(d_a, kAreaWeight) * d_c, 1.0 / (1 + kAreaWeight)) - 1;
}

double weighed_by_size(double aggregate, double domain_triangles) { return aggregate * std::sqrt(domain_triangles); }

namespace {

/// What a part of the triangles adds to the integrals.
struct Sums {
  double area = 0;
  double angle = 0;
  double stretch = 0;
  LatticeArea doubled_image = 0;
  std::int64_t folded = 0;

  Sums operator+(const Sums& other) const {
    return {area + other.area, angle + other.angle, stretch + other.stretch, doubled_image + other.doubled_image,
            folded + other.folded};
  }
};

/// The area of the surface, and of the domain in triangles of the largest scale.
struct Totals {
  double surface = 0;
  double domain = 0;
};

void add_triangle(const SourceMesh& mesh, const Parameterization& map, const Totals& totals, TriangleId t, Sums& sums) {
  const auto image = image_of(mesh, map, t);
  const LatticeArea doubled = image ? doubled_area(image->corners[0], image->corners[1], image->corners[2]) : 0;
  sums.doubled_image += doubled;
  if (doubled <= 0) {
    ++sums.folded;
    return;
  }
  const double own_area = triangle_area(mesh.positions, mesh.triangles[t]);
  if (own_area <= 0) return;
  const double share = own_area / totals.surface;
  const auto& [a, b, c] = mesh.triangles[t];
  const auto s =
      singular_values({plane_point(image->corners[0]), plane_point(image->corners[1]), plane_point(image->corners[2])},
                      {Vec3d(mesh.positions[a]), Vec3d(mesh.positions[b]), Vec3d(mesh.positions[c])});
  const double scale = area_at_level(map.first_level(image->home));
  const double image_share =
      static_cast<double>(doubled) / static_cast<double>(kUnitTriangleDoubledArea) * scale / totals.domain;
  sums.area += share * ((share / image_share + image_share / share) / 2 - 1);
  sums.angle += share * ((s.s1 / s.s2 + s.s2 / s.s1) / 2);
  sums.stretch += share * (s.s1 * s.s1 + s.s2 * s.s2) / 2 / scale;
}

}  // namespace

Distortion measure_distortion(const SourceMesh& mesh, const Parameterization& map) {
  const double surface = sum_of_parts(mesh.triangles.size(), [&](std::size_t begin, std::size_t end) {
    double area = 0;
    for (std::size_t t = begin; t < end; ++t) area += triangle_area(mesh.positions, mesh.triangles[t]);
    return area;
  });
  const Totals totals{surface, scaled_size(map)};
  const Sums sums = sum_of_parts(mesh.triangles.size(), [&](std::size_t begin, std::size_t end) {
    Sums part;
    for (std::size_t t = begin; t < end; ++t) add_triangle(mesh, map, totals, static_cast<TriangleId>(t), part);
    return part;
  });
  Distortion result;
  result.area = sums.area;
  result.angle = sums.angle - 1;
  result.aggregate = aggregate_of(1 + result.area, 1 + result.angle);
  const double domain_area = totals.domain * std::sqrt(3.0) / 4;
  result.l2_stretch = std::sqrt(sums.stretch * domain_area / surface);
  result.folded_triangles = sums.folded;
  const LatticeArea excess = sums.doubled_image - kUnitTriangleDoubledArea * map.domain.size();
  result.area_sum_error =
      std::abs(static_cast<double>(excess)) / (static_cast<double>(kUnitTriangleDoubledArea) * map.domain.size());
  return result;
}

}  // namespace lozenge
