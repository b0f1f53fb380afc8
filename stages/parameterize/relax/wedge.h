// The energy around one moving vertex, and Newton's step on it.
#pragma once

#include <array>
#include <vector>

#include "stages/parameterize/map/energy.h"
#include "stages/parameterize/map/lanes.h"
#include "stages/parameterize/map/working_map.h"

namespace lozenge {

/// Two triangles around a moving vertex, reduced to what depends on the vertex's displacement x from where it is now:
/// T = t + stiffness |x|^2 - 2 pull . x and d = base + slope . x.
struct TwoWedges {
  Lanes t, stiffness, pull_x, pull_y, base, slope_x, slope_y, share;
};

/// The triangles around a moving vertex: `start`, `add` them all, `close`.
class Wedges {
 public:
  Wedges() { pairs_.reserve(kUsualPairs); }

  /// \param scale  `WorkingMap::scale`
  void start(double scale) {
    pairs_.clear();
    is_half_ = false;
    scale_ = scale;
  }

  /// Adds a triangle whose corner `corner` moves; p and q are the next two counter-clockwise, seen from it.
  void add(const RestShape& rest, int corner, const Vec2d& p, const Vec2d& q) {
    const Triangle now{
        {rest.weight[corner], rest.weight[corner == 2 ? 0 : corner + 1], rest.weight[corner == 0 ? 2 : corner - 1]},
        rest.inverse_area,
        rest.share,
        p,
        q};
    if (is_half_) add_pair(half_, now);
    else half_ = now;
    is_half_ = !is_half_;
  }

  /// The last of an odd number is there twice, and counts once.
  void close() {
    if (!is_half_) return;
    Triangle again = half_;
    again.share = 0;
    add_pair(half_, again);
    is_half_ = false;
  }

  const std::vector<TwoWedges>& pairs() const { return pairs_; }

  /// Of the whole surface's area.
  double share() const;

 private:
  static constexpr std::size_t kUsualPairs = 4;  ///< most vertices have 6 triangles or about so many

  struct Triangle {
    std::array<double, 3> weight{};  ///< of the sides opposite the vertex, p and q
    double inverse_area = 0;
    double share = 0;
    Vec2d p, q;
  };

  void add_pair(const Triangle& first, const Triangle& second) {
    const Lanes px{first.p.x, second.p.x}, py{first.p.y, second.p.y};
    const Lanes qx{first.q.x, second.q.x}, qy{first.q.y, second.q.y};
    const Lanes across = Lanes{first.weight[0], second.weight[0]} * scale_;
    // The side from the vertex to p is opposite q, and the other way round.
    const Lanes to_q = Lanes{first.weight[1], second.weight[1]} * scale_;
    const Lanes to_p = Lanes{first.weight[2], second.weight[2]} * scale_;
    const Lanes area = Lanes{first.inverse_area, second.inverse_area} * scale_;
    const Lanes dx = qx - px, dy = qy - py;
    pairs_.push_back({
        .t = across * (dx * dx + dy * dy) + to_p * (px * px + py * py) + to_q * (qx * qx + qy * qy),
        .stiffness = to_p + to_q,
        .pull_x = px * to_p + qx * to_q,
        .pull_y = py * to_p + qy * to_q,
        .base = (px * qy - py * qx) * area,  // d = area * cross(p - x, q - x)
        .slope_x = -dy * area,
        .slope_y = dx * area,
        .share = Lanes{first.share, second.share},
    });
  }

  std::vector<TwoWedges> pairs_;
  Triangle half_;
  bool is_half_ = false;
  double scale_ = 1;
};

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
