// Triangles side by side must see their common edge alike: of free ends the motions between their homes are the same,
// of pinned ones, which have no rotation, the positions. And the straight line along an edge must lead through the
// domain the way that its charts say, which a walk along it tells; an operation that rewires the domain may have cut
// that way.
#include "stages/parameterize/map/consistency.h"

#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "stages/parameterize/map/images.h"
#include "stages/parameterize/map/pins.h"
#include "stages/parameterize/map/walk.h"

namespace lozenge {

namespace {

double squared_distance(const Vec2d& a, const Vec2d& b) { return (a - b).length2(); }

/// The relative motion of both ends of an edge, as a triangle's charts have it.
UnitMotion end_seen_from_start(const WorkingMap& map, Halfedge h) {
  return composed(inverse(map.chart[h]), map.chart[next_in_triangle(h)]);
}

bool agree_across(const WorkingMap& map, Halfedge h) {
  const Halfedge g = map.mesh.twins[h];
  if (g < 0) return true;
  const VertexId v = map.mesh.start(h);
  const VertexId w = map.mesh.end(h);
  const bool v_free = map.pin[v] < 0;
  const bool w_free = map.pin[w] < 0;
  if (v_free && w_free) {
    const bool same_here = map.chart[h] == map.chart[next_in_triangle(h)];
    const bool same_there = map.chart[g] == map.chart[next_in_triangle(g)];
    if (same_here || same_there) return same_here && same_there;  // nothing to compose, as inside of a home
    return end_seen_from_start(map, h) == inverse(end_seen_from_start(map, g));
  }
  if (v_free) {
    const UnitMotion there = composed(inverse(map.chart[next_in_triangle(g)]), map.chart[g]);
    return squared_distance(end_seen_from_start(map, h)(map.at[w]), there(map.at[w])) < kSamePoint;
  }
  if (w_free) {
    const UnitMotion here = composed(inverse(map.chart[next_in_triangle(h)]), map.chart[h]);
    return squared_distance(here(map.at[v]), end_seen_from_start(map, g)(map.at[v])) < kSamePoint;
  }
  const double here = squared_distance(map.chart[h](map.at[v]), map.chart[next_in_triangle(h)](map.at[w]));
  const double there = squared_distance(map.chart[g](map.at[w]), map.chart[next_in_triangle(g)](map.at[v]));
  return std::abs(here - there) < kSamePoint;
}

/// `seen` takes the frame of `home` into that of `walked`: whether they are one triangle, or two with the point on the
/// side between them.
bool is_same_place(const Domain& domain, const LineEnd& walked, DomainTriangleId home, const UnitMotion& seen) {
  if (walked.home == home) return seen == UnitMotion{};
  const auto w = barycentrics(walked.at);
  for (int s = 0; s < 3; ++s) {
    const DomainSide n = domain.neighbour({walked.home, s});
    if (n.triangle == home && std::abs(w[(s + 2) % 3]) < kSamePoint && unit_transition(s, n.side) == seen) return true;
  }
  return false;
}

/// A walk along several lines, one after the other; all stops in the frame of the start.
std::optional<LineEnd> walk_along(const Domain& domain, LineEnd place, const std::array<Vec2d, 3>& stops) {
  for (const Vec2d& stop : stops) {
    const auto further = walk(domain, place.home, place.at, inverse(place.back)(stop));
    if (!further) return std::nullopt;
    place = {further->home, further->at, composed(place.back, further->back)};
  }
  return place;
}

/// Whether the straight line along a half-edge leads through the domain as the triangle's charts have it.
bool line_agrees(const WorkingMap& map, Halfedge h) {
  Halfedge from = h;
  Halfedge to = next_in_triangle(h);
  if (map.pin[map.mesh.start(from)] >= 0) std::swap(from, to);
  const VertexId v = map.mesh.start(from);
  const VertexId w = map.mesh.start(to);
  if (map.pin[v] >= 0) return true;  // both are pinned: no chart tells
  const bool both_free = map.pin[w] < 0;
  // A line inside of a home meets no side.
  if (both_free && map.home[v] == map.home[w] && map.chart[from] == map.chart[to]) return true;
  const UnitMotion seen = composed(inverse(map.chart[from]), map.chart[to]);
  // Two triangles side by side are convex: a line between them meets no other side.
  for (int s = 0; s < 3 && both_free; ++s) {
    const DomainSide n = map.domain.neighbour({map.home[v], s});
    if (n.triangle == map.home[w] && unit_transition(s, n.side) == seen) return true;
  }
  const Vec2d end = seen(map.at[w]);
  const auto is_there = [&](const std::optional<LineEnd>& walked) {
    if (!walked) return false;
    if (map.pin[w] >= 0) return corner_there(map.domain, walked->home, walked->at, map.pin[w]) >= 0;
    return is_same_place(map.domain, *walked, map.home[w], composed(inverse(walked->back), seen));
  };
  if (is_there(walk(map.domain, map.home[v], map.at[v], end))) return true;
  // A line along a side of the domain may go either way around its end: once more, a little inside of the triangle.
  constexpr double kInward = 1e-6;
  const Halfedge third = 3 * (h / 3) + (3 - from % 3 - to % 3);
  const Vec2d apex = inverse(map.chart[from])(map.chart[third](map.at[map.mesh.start(third)]));
  const Vec2d start = map.at[v];
  const Vec2d inward = (apex - (start + end) / 2) * kInward;
  const Vec2d ahead = (end - start) * kInward;
  return is_there(
      walk_along(map.domain, {map.home[v], start, {}}, {start + ahead + inward, end - ahead + inward, end}));
}

}  // namespace

bool is_consistent(const WorkingMap& map, TriangleId t) {
  return agree_across(map, 3 * t) && agree_across(map, 3 * t + 1) && agree_across(map, 3 * t + 2);
}

bool agrees_with_domain(const WorkingMap& map, TriangleId t) {
  return line_agrees(map, 3 * t) && line_agrees(map, 3 * t + 1) && line_agrees(map, 3 * t + 2);
}

bool is_sound(const WorkingMap& map, VertexId v) {
  bool sound = true;
  for_each_outgoing(map.mesh, v, [&](Halfedge h) {
    sound = sound && doubled_image_area(map, h / 3) > 0 && is_consistent(map, h / 3);
  });
  return sound;
}

}  // namespace lozenge
