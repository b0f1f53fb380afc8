// The energy around one moving vertex, and Newton's step on it.
#pragma once

#include <vector>

#include "stages/parameterize/working_map.h"

namespace lozenge {

/// One triangle around a moving vertex, reduced to what depends on the vertex's position x:
/// T = far + a |x - p|^2 + b |x - q|^2 and d = base + slope . x, with p, q the next two corners counter-clockwise.
struct Wedge {
  Vec2d p, q;
  double a = 0, b = 0, far = 0;
  Vec2d slope;
  double base = 0;
  double share = 0;

  double t_at(const Vec2d& x) const { return far + a * (x - p).length2() + b * (x - q).length2(); }
  double d_at(const Vec2d& x) const { return base + slope.dot(x); }
};

using Wedges = std::vector<Wedge>;

/// The wedge of a triangle whose corner `corner` moves.
Wedge make_wedge(const RestShape& rest, int corner, const Vec2d& p, const Vec2d& q, double scale);

/// Infinite where a triangle is folded.
double energy_at(const Energy& energy, const Wedges& wedges, const Vec2d& x);

/// Newton's step from x, made to descend where the Hessian is indefinite, and cut so that every triangle keeps a tenth
/// of its area; and the energy at x.
struct NewtonStep {
  double energy = 0;  ///< infinite where a triangle is folded; the step is then of no use
  Vec2d step{0, 0};
};
NewtonStep newton_step(const Energy& energy, const Wedges& wedges, const Vec2d& x);

}  // namespace lozenge
