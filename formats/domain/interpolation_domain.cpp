#include "formats/domain/interpolation_domain.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>

#include "formats/domain/development.h"

namespace lozenge {

namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kSixth = kPi / 3;

double cross(const Vec2d& a, const Vec2d& b) { return a.x * b.y - a.y * b.x; }

std::optional<DomainPoint> as_domain_point(DomainTriangleId triangle, LatticePoint p) {
  if (!in_triangle(p)) return std::nullopt;
  return domain_point(triangle, p);
}

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
  const double area = cross(a, b);
  return {slice, cross(st, b) / area, cross(a, st) / area};
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
    const double det = cross(x, y);
    if (det == 0) break;
    w.first = std::max(0.0, w.first - cross(error, y) / det);
    w.second = std::max(0.0, w.second - cross(x, error) / det);
  }
  return w;
}

Vec2d polygon_corner(int valence, int i) {
  const double angle = 2 * kPi * i / valence;
  const double radius = star_radius(valence);
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

}  // namespace

FaceDomain::FaceDomain(const Domain&, DomainTriangleId triangle) : triangle_(triangle) {}

std::optional<DomainPoint> FaceDomain::to_domain(const Vec2d& st) const {
  return as_domain_point(triangle_, nearest_lattice_point(st));
}

std::optional<Vec2d> FaceDomain::from_domain(const DomainPoint& p) const {
  if (p.triangle != triangle_) return std::nullopt;
  return plane_point(lattice_point(p));
}

DiamondDomain::DiamondDomain(const Domain& domain, DomainSide side) : side_(side), across_(domain.neighbour(side)) {}

std::optional<DomainPoint> DiamondDomain::to_domain(const Vec2d& st) const {
  const LatticePoint here = nearest_lattice_point(st);
  if (in_triangle(here)) return domain_point(side_.triangle, here);
  return as_domain_point(across_.triangle, inverse(transition(side_.side, across_.side))(here));
}

std::optional<Vec2d> DiamondDomain::from_domain(const DomainPoint& p) const {
  if (p.triangle == side_.triangle) return plane_point(lattice_point(p));
  if (p.triangle != across_.triangle) return std::nullopt;
  return plane_point(transition(side_.side, across_.side)(lattice_point(p)));
}

StarDomain::StarDomain(const Domain& domain, DomainCorner first, StarShape shape)
    : corners_(corners_around(domain, first)), shape_(shape) {}

std::optional<DomainPoint> StarDomain::to_domain(const Vec2d& st) const {
  const StarSlice w = slice_in_star(valence(), st, shape_);
  constexpr double kSlack = 1e-12;  // what rounding may put outside of the slice
  if (w.first < -kSlack || w.second < -kSlack || w.first + w.second > 1 + kSlack) return std::nullopt;
  const DomainCorner at = corners_[w.slice];
  std::array<double, 3> barycentric{};
  barycentric[(at.corner + 1) % 3] = w.first;
  barycentric[(at.corner + 2) % 3] = w.second;
  barycentric[at.corner] = 1 - w.first - w.second;
  return make_point(at.triangle, barycentric[0], barycentric[1]);
}

std::optional<Vec2d> StarDomain::from_domain(const DomainPoint& p) const {
  for (int slice = 0; slice < valence(); ++slice) {
    const DomainCorner at = corners_[slice];
    if (at.triangle != p.triangle) continue;
    const std::array<double, 3> barycentric{p.alpha, p.beta, p.gamma()};
    return point_in_star(valence(), {slice, barycentric[(at.corner + 1) % 3], barycentric[(at.corner + 2) % 3]},
                         shape_);
  }
  return std::nullopt;
}

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

std::optional<DomainPoint> interpolate(const Domain& domain, const DomainPoint& p, const DomainPoint& q, double share) {
  if (p.triangle == q.triangle) {
    return make_point(p.triangle, p.alpha * (1 - share) + q.alpha * share, p.beta * (1 - share) + q.beta * share);
  }
  const auto between = [&](const auto& e) {
    return e.to_domain(*e.from_domain(p) * (1 - share) + *e.from_domain(q) * share);
  };
  for (int s = 0; s < 3; ++s) {
    if (domain.neighbour({p.triangle, s}).triangle == q.triangle)
      return between(DiamondDomain(domain, {p.triangle, s}));
  }
  for (int c = 0; c < 3; ++c) {
    const DomainCorner first{p.triangle, c};
    const StarDomain star(domain, first);
    if (star.from_domain(q) && next_around(domain, star.corners().back()) == first) return between(star);
  }
  return std::nullopt;
}

DomainSide half_diamond_of(const Domain& domain, const DomainPoint& p) {
  const std::array<double, 3> w{p.alpha, p.beta, p.gamma()};
  const auto smallest = static_cast<int>(std::min_element(w.begin(), w.end()) - w.begin());
  const DomainSide side{p.triangle, (smallest + 1) % 3};
  const DomainSide across = domain.neighbour(side);
  if (!across.exists() || 3 * side.triangle + side.side < 3 * across.triangle + across.side) return side;
  return across;
}

DomainVertex half_star_of(const Domain& domain, const DomainPoint& p) {
  const std::array<double, 3> w{p.alpha, p.beta, p.gamma()};
  return domain.corner(p.triangle, static_cast<int>(std::max_element(w.begin(), w.end()) - w.begin()));
}

BorderDistances border_distances(const DomainPoint& p) {
  std::array<double, 3> w{p.alpha, p.beta, p.gamma()};
  std::sort(w.begin(), w.end());
  const double height = std::sqrt(0.75);
  // A half-diamond ends where the two smallest weights are equal: on the segments from the barycentre to the corners.
  // A half-star, the polygon through the barycentres, ends where the two largest are: on those to the middles of the
  // sides. The difference of two weights grows by 2 for each unit of length across such a line.
  return {w[0] * height, (w[1] - w[0]) / 2, (w[2] - w[1]) / 2};
}

}  // namespace lozenge
