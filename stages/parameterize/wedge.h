// The energy around one moving vertex, and Newton's step on it.
#pragma once

#include <vector>

#include "stages/parameterize/working_map.h"

namespace lozenge {

/// One triangle around a moving vertex, reduced to what depends on the vertex's displacement x from where it is now:
/// T = t + stiffness |x|^2 - 2 pull . x and d = base + slope . x.
struct Wedge {
  double t = 0, stiffness = 0;
  Vec2d pull;
  double base = 0;
  Vec2d slope;
  double share = 0;

  double t_at(const Vec2d& x) const { return t + stiffness * x.length2() - 2 * pull.dot(x); }
  double d_at(const Vec2d& x) const { return base + slope.dot(x); }
};

using Wedges = std::vector<Wedge>;

/// The wedge of a triangle whose corner `corner` moves; p and q are the next two counter-clockwise, seen from it.
Wedge make_wedge(const RestShape& rest, int corner, const Vec2d& p, const Vec2d& q, double scale);

/// The energy after a displacement; infinite where a triangle is folded.
double energy_at(const Energy& energy, const Wedges& wedges, const Vec2d& x);

/// Newton's step, made to descend where the Hessian is indefinite, and cut so that every triangle keeps a tenth
/// of its area; and the energy before it.
struct NewtonStep {
  double energy = 0;  ///< infinite where a triangle is folded; the step is then of no use
  Vec2d step{0, 0};
};
NewtonStep newton_step(const Energy& energy, const Wedges& wedges);
/// The same of a vertex that moves along a line of this direction (of length 1) only.
NewtonStep newton_step_along(const Energy& energy, const Wedges& wedges, const Vec2d& direction);

}  // namespace lozenge
