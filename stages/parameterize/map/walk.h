// Walking straight lines over the domain, from one triangle's frame into the next.
//
// All transitions of the domain are rigid, so a straight line goes on straight in the frame of the triangle that it
// enters, and where it ends is found without a search. Around a cone the way matters: lines that pass it on different
// sides end in different places.
#pragma once

#include <optional>

#include "formats/domain/domain.h"
#include "stages/parameterize/map/plane_motion.h"

namespace lozenge {

/// A guard: a line that crosses so many triangles is none of an edge's.
inline constexpr int kMostTriangles = 64;

/// Where a straight line ends that starts in a domain triangle's frame: the triangle that holds the end, the end in its
/// frame, and the motion from there back into the frame of the start.
struct LineEnd {
  DomainTriangleId home = -1;
  Vec2d at;
  UnitMotion back;
};

/// \return nothing where the line leaves the domain over a boundary
std::optional<LineEnd> walk(const Domain& domain, DomainTriangleId frame, Vec2d from, Vec2d to);

/// The first side that such a line crosses for which `stop(side, its neighbour)` holds, and where.
struct Crossing {
  DomainSide side;   ///< of the triangle that is left
  double share = 0;  ///< of the way along the side
  UnitMotion back;   ///< from the frame of the triangle that is left into the frame of the start
};
template <typename Stop>
std::optional<Crossing> walk_until(const Domain& domain, DomainTriangleId frame, Vec2d from, Vec2d to, Stop&& stop);

/// One straight step of a walk: out of `frame` over its first side on the way, or none where the line ends inside.
struct SideCrossed {
  int side = -1;
  double along = 0;  ///< share of the line before the side
};
SideCrossed first_side_on(const Vec2d& from, const Vec2d& to);

template <typename Stop>
std::optional<Crossing> walk_until(const Domain& domain, DomainTriangleId frame, Vec2d from, Vec2d to, Stop&& stop) {
  UnitMotion back;
  for (int step = 0; step < kMostTriangles; ++step) {
    const SideCrossed crossed = first_side_on(from, to);
    if (crossed.side < 0) return std::nullopt;
    const DomainSide side{frame, crossed.side};
    const DomainSide n = domain.neighbour(side);
    if (!n.exists()) return std::nullopt;
    from += (to - from) * crossed.along;
    if (stop(side, n)) return Crossing{side, to_corner_frame(crossed.side)(from).x, back};
    const UnitMotion& across = unit_transition(n.side, crossed.side);
    from = across(from);
    to = across(to);
    back = composed(back, unit_transition(crossed.side, n.side));
    frame = n.triangle;
  }
  return std::nullopt;
}

}  // namespace lozenge
