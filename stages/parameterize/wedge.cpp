#include "stages/parameterize/wedge.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lozenge {

namespace {

/// The energy and its first two derivatives at no displacement.
struct LocalExpansion {
  double f = 0;
  double gx = 0, gy = 0;
  double hxx = 0, hxy = 0, hyy = 0;
};

/// Infinite where a triangle is folded.
LocalExpansion expand(const Energy& energy, const Wedges& wedges) {
  LocalExpansion sum;
  for (const Wedge& w : wedges) {
    if (!(w.base > 0)) {
      sum.f = std::numeric_limits<double>::infinity();
      return sum;
    }
    const Vec2d t1 = w.pull * -2.0;
    const EnergyDerivatives e = differentiate(energy, w.t, w.base);
    sum.f += w.share * e.f;
    sum.gx += w.share * (e.f_t * t1.x + e.f_d * w.slope.x);
    sum.gy += w.share * (e.f_t * t1.y + e.f_d * w.slope.y);
    const double round = e.f_t * 2 * w.stiffness;
    sum.hxx += w.share * (round + 2 * e.f_td * t1.x * w.slope.x + e.f_dd * w.slope.x * w.slope.x);
    sum.hyy += w.share * (round + 2 * e.f_td * t1.y * w.slope.y + e.f_dd * w.slope.y * w.slope.y);
    sum.hxy += w.share * (e.f_td * (t1.x * w.slope.y + t1.y * w.slope.x) + e.f_dd * w.slope.x * w.slope.y);
  }
  return sum;
}

/// Newton's direction, made to descend where the Hessian is indefinite.
Vec2d newton_direction(LocalExpansion e) {
  // Lift the smaller eigenvalue to a small share of the larger one.
  const double mean = (e.hxx + e.hyy) / 2;
  const double radius = std::sqrt((e.hxx - e.hyy) * (e.hxx - e.hyy) / 4 + e.hxy * e.hxy);
  const double largest = std::max(std::abs(mean + radius), std::abs(mean - radius));
  const double lift = std::max(0.0, 1e-3 * largest - (mean - radius));
  e.hxx += lift;
  e.hyy += lift;
  const double det = e.hxx * e.hyy - e.hxy * e.hxy;
  if (!(det > 0)) return {-e.gx, -e.gy};
  return {(e.hxy * e.gy - e.hyy * e.gx) / det, (e.hxy * e.gx - e.hxx * e.gy) / det};
}

Vec2d newton_direction_along(const LocalExpansion& e, const Vec2d& direction) {
  const double slope = e.gx * direction.x + e.gy * direction.y;
  const double curvature =
      direction.x * (e.hxx * direction.x + 2 * e.hxy * direction.y) + direction.y * e.hyy * direction.y;
  // Where the energy bends down, as far as were it bending up.
  return curvature != 0 ? direction * (-slope / std::abs(curvature)) : Vec2d(0, 0);
}

/// The largest share of `step`, at most 1, that keeps every triangle around at a tenth of its area or more.
double longest_step(const Wedges& wedges, const Vec2d& step) {
  double most = 1;
  for (const Wedge& w : wedges) {
    const double fall = -w.slope.dot(step);
    if (fall > 0 && fall * most > 0.9 * w.base) most = 0.9 * w.base / fall;
  }
  return most;
}

}  // namespace

Wedge make_wedge(const RestShape& rest, int corner, const Vec2d& p, const Vec2d& q, double scale) {
  Wedge w;
  // The side from the vertex to p is opposite the corner of q, and the other way round.
  const double a = rest.weight[(corner + 2) % 3] * scale;
  const double b = rest.weight[(corner + 1) % 3] * scale;
  w.stiffness = a + b;
  w.pull = p * a + q * b;
  w.t = rest.weight[corner] * scale * (q - p).length2() + a * p.length2() + b * q.length2();
  const double area = rest.inverse_area * scale;
  w.slope = Vec2d(p.y - q.y, q.x - p.x) * area;  // d = area * cross(p - x, q - x)
  w.base = cross(p, q) * area;
  w.share = rest.share;
  return w;
}

double energy_at(const Energy& energy, const Wedges& wedges, const Vec2d& x) {
  double sum = 0;
  for (const Wedge& w : wedges) {
    const double d = w.d_at(x);
    if (!(d > 0)) return std::numeric_limits<double>::infinity();
    sum += w.share * evaluate(energy, w.t_at(x), d);
  }
  return sum;
}

NewtonStep newton_step(const Energy& energy, const Wedges& wedges) {
  const LocalExpansion e = expand(energy, wedges);
  if (!(e.f < std::numeric_limits<double>::infinity())) return {e.f, {0, 0}};
  const Vec2d step = newton_direction(e);
  return {e.f, step * longest_step(wedges, step)};
}

NewtonStep newton_step_along(const Energy& energy, const Wedges& wedges, const Vec2d& direction) {
  const LocalExpansion e = expand(energy, wedges);
  if (!(e.f < std::numeric_limits<double>::infinity())) return {e.f, {0, 0}};
  const Vec2d step = newton_direction_along(e, direction);
  return {e.f, step * longest_step(wedges, step)};
}

}  // namespace lozenge
