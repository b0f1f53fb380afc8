// A slice keeps its two weights: linear in the polygon where areas count, in polar coordinates scaled by a power where
// angles do (Sec. 4.1). What lies between the two has no closed inverse; Newton's method finds it.
#include "formats/domain/star_domain.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace lozenge {

namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kSixth = kPi / 3;

/// Area-keeping: a slice is a linear image of the triangle.
Vec2d linear_from_slice(int valence, const StarSlice& w) {
  return star_corner(valence, w.slice) * w.first + star_corner(valence, w.slice + 1) * w.second;
}

/// Angle-keeping: in the unfolded star a point has polar coordinates (r, slice * 60 degrees + angle); the angle shrinks
/// by 6 / valence and the radius is raised to that power.
Vec2d conformal_from_slice(int valence, const StarSlice& w) {
  const Vec2d p(w.first + w.second / 2, w.second * std::sqrt(0.75));
  const double power = 6.0 / valence;
  const double angle = (w.slice * kSixth + std::atan2(p.y, p.x)) * power;
  const double radius = star_radius(valence) * std::pow(p.length(), power);
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

int slice_at(int valence, const Vec2d& st) {
  const double turn = std::atan2(st.y, st.x) / (2 * kPi);
  const int slice = static_cast<int>(std::floor((turn < 0 ? turn + 1 : turn) * valence));
  return std::clamp(slice, 0, valence - 1);
}

StarSlice linear_to_slice(int valence, int slice, const Vec2d& st) {
  const Vec2d a = star_corner(valence, slice);
  const Vec2d b = star_corner(valence, slice + 1);
  const double area = a.cross(b);
  return {slice, st.cross(b) / area, a.cross(st) / area};
}

StarSlice conformal_to_slice(int valence, int slice, const Vec2d& st) {
  const double power = valence / 6.0;
  const double turn = std::atan2(st.y, st.x);
  const double angle = (turn < 0 ? turn + 2 * kPi : turn) * power - slice * kSixth;
  const double radius = std::pow(st.length() / star_radius(valence), power);
  const double second = radius * std::sin(angle) / std::sqrt(0.75);
  return {slice, radius * std::cos(angle) - second / 2, second};
}

/// Inverts the blend by Newton's method inside the slice, with differences for derivatives; both ends are exact
/// inverses, so their blend is a good start.
StarSlice blended_to_slice(int valence, int slice, const Vec2d& st, double conformality) {
  const StarSlice linear = linear_to_slice(valence, slice, st);
  const StarSlice conformal = conformal_to_slice(valence, slice, st);
  StarSlice w{slice, linear.first * (1 - conformality) + conformal.first * conformality,
              linear.second * (1 - conformality) + conformal.second * conformality};
  constexpr double kStep = 1e-7;
  for (int iteration = 0; iteration < 30; ++iteration) {
    const Vec2d error = point_in_star(valence, w, {conformality}) - st;
    if (error.length() < 1e-14) break;
    const Vec2d x = (point_in_star(valence, {slice, w.first + kStep, w.second}, {conformality}) - st - error) / kStep;
    const Vec2d y = (point_in_star(valence, {slice, w.first, w.second + kStep}, {conformality}) - st - error) / kStep;
    const double det = x.cross(y);
    if (det == 0) break;
    w.first = std::max(0.0, w.first - error.cross(y) / det);
    w.second = std::max(0.0, w.second - x.cross(error) / det);
  }
  return w;
}

Vec2d polygon_corner(int valence, int i) {
  const double angle = 2 * kPi * i / valence;
  const double radius = star_radius(valence);
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

}  // namespace

StarSlice slice_in_star(int valence, const Vec2d& st, StarShape shape) {
  const int slice = slice_at(valence, st);
  if (shape.conformality == 0) return linear_to_slice(valence, slice, st);
  if (shape.conformality == 1) return conformal_to_slice(valence, slice, st);
  return blended_to_slice(valence, slice, st, shape.conformality);
}

Vec2d point_in_star(int valence, const StarSlice& at, StarShape shape) {
  if (shape.conformality == 0) return linear_from_slice(valence, at);
  const Vec2d conformal = conformal_from_slice(valence, at);
  return linear_from_slice(valence, at) * (1 - shape.conformality) + conformal * shape.conformality;
}

double star_radius(int valence) {
  // valence / 2 R^2 sin(2 pi / valence) = valence sqrt(3) / 4
  return std::sqrt(std::sqrt(0.75) / std::sin(2 * kPi / valence));
}

Vec2d star_corner(int valence, int i) {
  // Asked for again and again for the same few polygons.
  constexpr int kMostKept = 16;
  static const auto kept = [] {
    std::array<std::array<Vec2d, kMostKept + 1>, kMostKept + 1> table;
    for (int k = 3; k <= kMostKept; ++k) {
      for (int c = 0; c <= k; ++c) table[k][c] = polygon_corner(k, c);
    }
    return table;
  }();
  return valence <= kMostKept && i >= 0 && i <= valence ? kept[valence][i] : polygon_corner(valence, i);
}

}  // namespace lozenge
