// A vertex slides along the line of its side; beyond the side's end the next one goes straight on where three triangles
// lie around the corner between them, and turning through these gives the motion between the two sides' frames.
#include "stages/parameterize/map/boundary.h"

#include <algorithm>
#include <cmath>

#include "formats/base/error.h"
#include "stages/parameterize/map/homes.h"
#include "stages/parameterize/map/star.h"

namespace lozenge {

namespace {

/// A corner of the fan around one vertex, and the motion from its triangle's frame into that of the first one.
struct FanCorner {
  DomainCorner corner;
  UnitMotion back;
};

/// The next corner clockwise (across the side that leaves the vertex) or counter-clockwise (across the one that
/// arrives).
std::optional<FanCorner> turned(const Domain& domain, const FanCorner& from, bool clockwise) {
  const DomainCorner next = clockwise ? previous_around(domain, from.corner) : next_around(domain, from.corner);
  if (next.triangle < 0) return std::nullopt;
  const int crossed = clockwise ? from.corner.corner : (from.corner.corner + 2) % 3;
  const int entered = clockwise ? (next.corner + 2) % 3 : next.corner;
  return FanCorner{next, composed(from.back, unit_transition(crossed, entered))};
}

/// The other end of a fan of three triangles; nothing where it has more or fewer.
std::optional<FanCorner> across_a_straight_fan(const Domain& domain, DomainCorner corner, bool clockwise) {
  std::optional<FanCorner> here = FanCorner{corner, {}};
  for (int i = 0; i < 2 && here; ++i) here = turned(domain, *here, clockwise);
  if (!here || turned(domain, *here, clockwise)) return std::nullopt;
  return here;
}

}  // namespace

std::optional<SlideEnd> slide(const Domain& domain, BoundaryPlace place) {
  constexpr int kMostSides = 64;  // a guard: no step is that long
  UnitMotion back;
  for (int i = 0; i < kMostSides; ++i) {
    const bool forward = place.along > 1;
    if (!forward && !(place.along < 0)) return SlideEnd{place, back};
    const int corner = forward ? (place.side.side + 1) % 3 : place.side.side;
    const auto next = across_a_straight_fan(domain, {place.side.triangle, corner}, forward);
    if (!next) return std::nullopt;
    const int side = forward ? next->corner.corner : (next->corner.corner + 2) % 3;
    place = {{next->corner.triangle, side}, forward ? place.along - 1 : place.along + 1};
    back = composed(back, next->back);
  }
  return std::nullopt;
}

Vec2d position_of(const BoundaryPlace& place) {
  return corner_position(place.side.side) + direction_of(place.side.side) * place.along;
}

Vec2d direction_of(int side) { return corner_position((side + 1) % 3) - corner_position(side); }

BoundaryPlace boundary_place(const WorkingMap& map, VertexId v, const Vec2d& at) {
  const DomainTriangleId home = map.home[v];
  const auto w = barycentrics(at);
  int side = -1;
  for (int s = 0; s < 3; ++s) {
    if (map.domain.neighbour({home, s}).exists()) continue;
    if (side < 0 || std::abs(w[(s + 2) % 3]) < std::abs(w[(side + 2) % 3])) side = s;
  }
  if (side < 0) throw Error(ExitCode::kInternal, "the map lost its boundary; please report this");
  return {{home, side}, direction_of(side).dot(at - corner_position(side))};
}

bool slide_to(WorkingMap& map, VertexId v, const Vec2d& to) {
  BoundaryPlace place = boundary_place(map, v);
  place.along += direction_of(place.side.side).dot(to - map.at[v]);
  const auto slid = slide(map.domain, place);
  if (!slid) return false;
  if (slid->place.side.triangle == map.home[v]) map.at[v] = position_of(slid->place);
  else move_home(map, v, slid->place.side.triangle, position_of(slid->place), slid->back);
  return true;
}

void move_to_first_of_fan(WorkingMap& map, VertexId v, DomainCorner corner) {
  FanCorner first{corner, {}};
  while (const auto before = turned(map.domain, first, true)) first = *before;
  move_home(map, v, first.corner.triangle, corner_position(first.corner.corner), first.back);
}

std::optional<PlaceBetween> place_between(const WorkingMap& map, Halfedge h, double share) {
  const Halfedge end = next_in_triangle(h);
  const VertexId v = map.mesh.start(h);
  const VertexId w = map.mesh.start(end);
  const Vec2d p = map.chart[h](map.at[v]);
  const Vec2d q = map.chart[end](map.at[w]);
  const double length = (q - p).length();
  if (!(length > 0)) return std::nullopt;
  BoundaryPlace start;
  if (map.pin[v] < 0) {
    start = boundary_place(map, v);
    start.along += share * length;
  } else if (map.pin[w] < 0) {
    start = boundary_place(map, w);
    start.along -= (1 - share) * length;
  } else {
    const DomainCorner first = star_of(map, map.pin[v]).front();
    start = {{first.triangle, first.corner}, share * length};
  }
  const auto slid = slide(map.domain, start);
  if (!slid) return std::nullopt;
  const Vec2d at = position_of(slid->place);
  const Vec2d image = p + (q - p) * share;
  return PlaceBetween{slid->place,
                      motion_of_segment(at, at + direction_of(slid->place.side.side), image, image + (q - p) / length)};
}

}  // namespace lozenge
