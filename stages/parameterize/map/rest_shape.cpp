// A triangle stands on its longest side: its base and height are well known even where it is a needle, and raising the
// height is all that is done to one.
#include "stages/parameterize/map/rest_shape.h"

#include <algorithm>
#include <cmath>

#include "formats/base/parallel.h"

namespace lozenge {

namespace {

/// A triangle on its longest side.
struct Upright {
  int apex = 0;     ///< the corner opposite that side
  double base = 0;  ///< the side's length
  double foot = 0;  ///< where the height meets it, from the corner after the apex on
  double height = 0;
};

Upright upright(const std::vector<Vec3f>& positions, const std::array<VertexId, 3>& triangle) {
  std::array<Vec3d, 3> side;  // opposite corner i, from corner i + 1 to i + 2
  for (int i = 0; i < 3; ++i) {
    side[i] = Vec3d(positions[triangle[(i + 2) % 3]]) - Vec3d(positions[triangle[(i + 1) % 3]]);
  }
  Upright t;
  for (int i = 1; i < 3; ++i) {
    if (side[i].length2() > side[t.apex].length2()) t.apex = i;
  }
  const Vec3d along = side[t.apex];
  const Vec3d up = -side[(t.apex + 2) % 3];
  t.base = along.length();
  if (!(t.base > 0)) return t;
  t.foot = std::clamp(up.dot(along) / t.base, 0.0, t.base);
  t.height = along.cross(up).length() / t.base;
  return t;
}

constexpr std::array<double, 2> kTried{1e-2, 3e-3};

/// Doubled areas: of the whole surface, and of the triangles that are flatter than each of `kTried`.
struct Flat {
  double whole = 0;
  std::array<double, 2> flatter{};

  void add(const Upright& t) {
    const double doubled = t.base * t.height;
    whole += doubled;
    for (std::size_t i = 0; i < kTried.size(); ++i) {
      if (t.height < kTried[i] * t.base) flatter[i] += doubled;
    }
  }
  Flat operator+(const Flat& other) const {
    return {whole + other.whole, {flatter[0] + other.flatter[0], flatter[1] + other.flatter[1]}};
  }
};

}  // namespace

RestShape rest_shape(const std::vector<Vec3f>& positions, const std::array<VertexId, 3>& triangle, double surface_area,
                     double flattest) {
  Upright t = upright(positions, triangle);
  // Beside the whole surface, a triangle of this size is a point.
  constexpr double kSmallest = 1e-7;
  const double area = t.base * t.height;
  const double smallest = kSmallest * std::sqrt(surface_area);
  t.base = std::max(t.base, smallest);
  t.height = std::max(t.height, flattest * t.base);
  const double doubled = t.base * t.height;
  const double rest = t.base - t.foot;
  std::array<double, 3> cotangent{};
  cotangent[t.apex] = (t.height * t.height - t.foot * rest) / doubled;
  cotangent[(t.apex + 1) % 3] = t.foot / t.height;
  cotangent[(t.apex + 2) % 3] = rest / t.height;
  RestShape shape;
  for (int i = 0; i < 3; ++i) shape.weight[i] = static_cast<float>(cotangent[i] / doubled);
  shape.inverse_area = static_cast<float>(1 / doubled);
  shape.share = static_cast<float>(std::max(area, flattest * smallest * smallest) / 2 / surface_area);
  return shape;
}

double flattest_to_keep(const std::vector<Vec3f>& positions, const std::vector<std::array<VertexId, 3>>& triangles) {
  constexpr double kMostOfSurface = 0.01;
  const Flat areas = sum_of_parts(triangles.size(), [&](std::size_t begin, std::size_t end) {
    Flat part;
    for (std::size_t i = begin; i < end; ++i) part.add(upright(positions, triangles[i]));
    return part;
  });
  for (std::size_t i = 0; i < kTried.size(); ++i) {
    if (areas.flatter[i] <= kMostOfSurface * areas.whole) return kTried[i];
  }
  return kFlattest;
}

}  // namespace lozenge
