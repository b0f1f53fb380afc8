// A gate is found by walking along the triangle's own edge between a corner outside and one inside: where the line
// enters the region (or leaves it), it crosses the rim. A line that ends on the rim without crossing it touches its
// gate there.
#include "stages/parameterize/map/surroundings.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "stages/parameterize/map/consistency.h"
#include "stages/parameterize/map/walk.h"

namespace lozenge {

namespace {

/// A line to a corner of the rim ends this much before it, so that rounding doesn't carry it across.
constexpr double kAlmost = 1 - 1e-9;

class Surroundings {
 public:
  Surroundings(const WorkingMap& map, const Region& region, Scratch& scratch)
      : map_(map), region_(region), inside_(scratch.domain_triangles), moving_(scratch.vertices) {
    inside_.clear(map.domain.triangles.size());
    for (const DomainTriangleId t : region.triangles) inside_.add(t);
    moving_.clear(map.home.size());
    for (const VertexId v : region.moving) moving_.add(v);
  }

  bool find_gate(TriangleId t, Gate& gate) const {
    const auto& corners = map_.mesh.triangles[t];
    int mover = -1, free_mover = -1, outsider = -1, free_outsider = -1, rim = -1;
    for (int c = 0; c < 3; ++c) {
      const bool is_free = map_.pin[corners[c]] < 0;
      if (moving_.has(corners[c])) {
        mover = c;
        if (is_free) free_mover = c;
      } else if (is_free) {
        free_outsider = c;
      } else if (on_rim(map_.pin[corners[c]])) {
        rim = c;
      } else {
        outsider = c;
      }
    }
    if (free_outsider >= 0) return enter(t, free_outsider, mover, gate);
    if (outsider >= 0) return free_mover >= 0 && leave(t, free_mover, outsider, gate);
    // A pinned corner on the rim may be reached from outside, too, where the mesh is coarse.
    if (rim >= 0 && free_mover >= 0) leave(t, free_mover, rim, gate);
    return true;
  }

 private:
  bool on_rim(DomainVertex n) const {
    return std::find(region_.rim.begin(), region_.rim.end(), n) != region_.rim.end();
  }

  /// The line between two corners, in the frame of the first one's home.
  Vec2d target(TriangleId t, int from, int to) const {
    const UnitMotion seen = composed(inverse(map_.chart[3 * t + from]), map_.chart[3 * t + to]);
    return seen(map_.at[map_.mesh.triangles[t][to]]);
  }

  bool enter(TriangleId t, int from, int to, Gate& gate) const {
    const VertexId w = map_.mesh.triangles[t][from];
    const Vec2d end = target(t, from, to);
    auto crossing = walk_until(map_.domain, map_.home[w], map_.at[w], end,
                               [&](DomainSide, DomainSide n) { return inside_.has(n.triangle); });
    if (!crossing) crossing = touch(map_.home[w], map_.at[w], end);
    if (!crossing) return false;
    gate = {crossing->side, crossing->share, composed(map_.chart[3 * t + from], crossing->back)};
    return true;
  }

  /// The side of the rim that a line ends on, without crossing it.
  std::optional<Crossing> touch(DomainTriangleId frame, const Vec2d& from, const Vec2d& to) const {
    constexpr double kNear = 1e-9;
    const auto walked = walk(map_.domain, frame, from, to);
    if (!walked) return std::nullopt;
    const auto w = barycentrics(walked->at);
    for (int s = 0; s < 3; ++s) {
      const DomainSide n = map_.domain.neighbour({walked->home, s});
      if (!n.exists() || !inside_.has(n.triangle) || std::abs(w[(s + 2) % 3]) > kNear) continue;
      return Crossing{{walked->home, s}, to_corner_frame(s)(walked->at).x, walked->back};
    }
    return std::nullopt;
  }

  bool leave(TriangleId t, int from, int to, Gate& gate) const {
    const VertexId v = map_.mesh.triangles[t][from];
    const Vec2d end = map_.at[v] + (target(t, from, to) - map_.at[v]) * kAlmost;
    const auto crossing = walk_until(map_.domain, map_.home[v], map_.at[v], end,
                                     [&](DomainSide, DomainSide n) { return !inside_.has(n.triangle); });
    if (!crossing) return false;
    const DomainSide outer = map_.domain.neighbour(crossing->side);
    const UnitMotion back = composed(crossing->back, unit_transition(crossing->side.side, outer.side));
    gate = {outer, 1 - crossing->share, composed(map_.chart[3 * t + from], back)};
    return true;
  }

  const WorkingMap& map_;
  const Region& region_;
  Marks& inside_;
  Marks& moving_;
};

}  // namespace

std::optional<std::vector<MovingTriangle>> find_surroundings(const WorkingMap& map, const Region& region,
                                                             const std::vector<TriangleId>& triangles,
                                                             Scratch& scratch) {
  const Surroundings surroundings(map, region, scratch);
  std::vector<MovingTriangle> found;
  found.reserve(triangles.size());
  for (const TriangleId t : triangles) {
    found.push_back({t, {}});
    if (!surroundings.find_gate(t, found.back().gate)) return std::nullopt;
  }
  return found;
}

bool are_consistent(const WorkingMap& map, const std::vector<MovingTriangle>& moving) {
  // The triangles beside have no corner that moved, but where the mesh is coarse one may reach through the region.
  return std::all_of(moving.begin(), moving.end(), [&](const MovingTriangle& h) {
    const Halfedge first = 3 * h.triangle;
    if (!is_consistent(map, h.triangle) || !agrees_with_domain(map, h.triangle)) return false;
    if (h.is_inside()) return true;
    for (Halfedge e = first; e < first + 3; ++e) {
      if (map.mesh.twins[e] >= 0 && !agrees_with_domain(map, map.mesh.twins[e] / 3)) return false;
    }
    return true;
  });
}

}  // namespace lozenge
