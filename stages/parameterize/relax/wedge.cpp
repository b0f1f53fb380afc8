// With the other vertices held, T is quadratic and d linear in the displacement, so the energy's expansion is a few
// products for each triangle, calculated for two of them at once.
#include "stages/parameterize/relax/wedge.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lozenge {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The energy and its first two derivatives at no displacement.
struct LocalExpansion {
  double f = 0;
  double gx = 0, gy = 0;
  double hxx = 0, hxy = 0, hyy = 0;
};

/// Infinite where a triangle is folded.
LocalExpansion expand(const Energy& energy, const Wedges& wedges) {
  Lanes f{}, gx{}, gy{}, hxx{}, hxy{}, hyy{};
  for (const TwoWedges& w : wedges.pairs()) {
    if (!all(w.base > 0.0)) return {kInfinity};
    const EnergyDerivatives<Lanes> e = differentiate(energy, w.t, w.base);
    const Lanes tx = -2.0 * w.pull_x;
    const Lanes ty = -2.0 * w.pull_y;
    const Lanes round = 2.0 * e.f_t * w.stiffness;
    f += w.share * e.f;
    gx += w.share * (e.f_t * tx + e.f_d * w.slope_x);
    gy += w.share * (e.f_t * ty + e.f_d * w.slope_y);
    hxx += w.share * (round + (2.0 * e.f_td * tx + e.f_dd * w.slope_x) * w.slope_x);
    hyy += w.share * (round + (2.0 * e.f_td * ty + e.f_dd * w.slope_y) * w.slope_y);
    hxy += w.share * (e.f_td * (tx * w.slope_y + ty * w.slope_x) + e.f_dd * w.slope_x * w.slope_y);
  }
  return {sum(f), sum(gx), sum(gy), sum(hxx), sum(hxy), sum(hyy)};
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
  Lanes most = Lanes{} + 1.0;
  for (const TwoWedges& w : wedges.pairs()) {
    const Lanes fall = -(w.slope_x * step.x + w.slope_y * step.y);
    const Lanes room = 0.9 * w.base;
    const Lanes share = room / fall;
    most = (fall > room) & (share < most) ? share : most;
  }
  return std::min(most[0], most[1]);
}

}  // namespace

double Wedges::share() const {
  Lanes total{};
  for (const TwoWedges& w : pairs()) total += w.share;
  return sum(total);
}

double energy_at(const Energy& energy, const Wedges& wedges, const Vec2d& x) {
  Lanes total{};
  for (const TwoWedges& w : wedges.pairs()) {
    const Lanes d = w.base + (w.slope_x * x.x + w.slope_y * x.y);
    if (!all(d > 0.0)) return kInfinity;
    const Lanes t = w.t + w.stiffness * x.length2() - 2.0 * (w.pull_x * x.x + w.pull_y * x.y);
    total += w.share * evaluate(energy, t, d);
  }
  return sum(total);
}

NewtonStep newton_step(const Energy& energy, const Wedges& wedges) {
  const LocalExpansion e = expand(energy, wedges);
  if (!(e.f < kInfinity)) return {e.f, {0, 0}};
  const Vec2d step = newton_direction(e);
  return {e.f, step * longest_step(wedges, step)};
}

NewtonStep newton_step_along(const Energy& energy, const Wedges& wedges, const Vec2d& direction) {
  const LocalExpansion e = expand(energy, wedges);
  if (!(e.f < kInfinity)) return {e.f, {0, 0}};
  const Vec2d step = newton_direction_along(e, direction);
  return {e.f, step * longest_step(wedges, step)};
}

}  // namespace lozenge
