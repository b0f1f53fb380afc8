// The triangles are unfolded one after the other into the frame of the first. A place is tried by whether all sides of
// the outline turn left around it, and its home found by walking there from a corner that is free.
#include "stages/parameterize/map/fan.h"

#include <algorithm>
#include <cmath>

#include "stages/parameterize/map/boundary.h"
#include "stages/parameterize/map/images.h"
#include "stages/parameterize/map/kernel.h"
#include "stages/parameterize/map/walk.h"

namespace lozenge {

namespace {

constexpr double kPi = 3.14159265358979323846;

Vec2d times(const Vec2d& a, const Vec2d& b) { return {a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x}; }

/// The smallest doubled area of the triangles between a point and the sides of an outline, relative to the squared
/// size.
double smallest_area(const std::vector<Vec2d>& outline, const Vec2d& x) {
  double least = 1e300;
  double size = 0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec2d& p = outline[i];
    const Vec2d& q = outline[i + 1 == outline.size() ? 0 : i + 1];
    least = std::min(least, cross(p - x, q - x));
    size = std::max(size, (p - x).length2());
  }
  return least / size;
}

/// Tries points of a fan that see its whole outline.
class PlaceFinder {
 public:
  PlaceFinder(const WorkingMap& map, const Fan& fan) : map_(map), fan_(fan) {
    for (std::size_t i = 1; i + 1 < fan_.outline.size(); ++i) {
      const Vec2d p = fan_.outline[i] - fan_.centre();
      const Vec2d q = fan_.outline[i + 1] - fan_.centre();
      angle_ += std::atan2(cross(p, q), p.dot(q));
    }
  }

  /// The place that the vertex has in space, the middle of what the whole outline is seen from, or points ever nearer
  /// to the vertex in the middle of the fan, half-way between its two neighbours on the outline.
  std::optional<PlaceInFan> find(const Vec2d& as_in_space) const {
    constexpr double kSafe = 1e-3;
    // A layout of more than a full turn covers itself, and nothing sees all of it but once.
    if (angle_ > 2 * kPi - kSafe) return std::nullopt;
    if (smallest_area(fan_.outline, as_in_space) > kSafe) {
      if (auto place = at(as_in_space)) return place;
    }
    if (const auto middle = point_of_kernel(fan_.outline)) {
      if (auto place = at(*middle)) return place;
    }
    const Vec2d ahead = direction_into();
    for (double step = 0.25; step > 1e-6; step /= 2) {
      if (auto place = at(fan_.centre() + ahead * step)) return place;
    }
    return std::nullopt;
  }

 private:
  /// The bisector of the fan's angle, as long as the shorter of the two sides there.
  Vec2d direction_into() const {
    const Vec2d first = fan_.outline[1] - fan_.centre();
    const double last = (fan_.outline.back() - fan_.centre()).length();
    const Vec2d ahead = times(first, {std::cos(angle_ / 2), std::sin(angle_ / 2)});
    return ahead * (std::min(first.length(), last) / first.length());
  }

  std::optional<PlaceInFan> at(const Vec2d& p) const {
    if (!(smallest_area(fan_.outline, p) > 0)) return std::nullopt;
    // From any corner that is free the straight way lies inside of the fan.
    for (const Fan::Slice& slice : fan_.slices) {
      for (const Halfedge h : {slice.spoke, next_in_triangle(slice.spoke), previous_in_triangle(slice.spoke)}) {
        if (auto place = from_corner(h, slice.into_fan, {}, p)) return place;
      }
    }
    // All are pinned: from the corner beyond a side of the outline, through the middle of the side.
    for (const Fan::Slice& slice : fan_.slices) {
      const Halfedge side = next_in_triangle(slice.spoke);
      if (map_.mesh.twins[side] < 0) continue;
      const Halfedge beyond = previous_in_triangle(map_.mesh.twins[side]);
      const UnitMotion back = composed(slice.into_fan, motion_across(map_, map_.mesh.twins[side]));
      const auto image = [&](Halfedge h) { return slice.into_fan(map_.chart[h](map_.at[map_.mesh.start(h)])); };
      const Vec2d middle = (image(side) + image(next_in_triangle(side))) / 2;
      if (auto place = from_corner(beyond, back, middle, p)) return place;
    }
    return std::nullopt;
  }

  /// Walks from the start of `h`, whose triangle's frame `into_fan` takes into the layout, to p.
  std::optional<PlaceInFan> from_corner(Halfedge h, const UnitMotion& into_fan, const std::optional<Vec2d>& by,
                                        const Vec2d& p) const {
    const VertexId w = map_.mesh.start(h);
    if (map_.pin[w] >= 0) return std::nullopt;
    UnitMotion motion = composed(into_fan, map_.chart[h]);
    LineEnd walked{map_.home[w], map_.at[w], {}};
    for (const std::optional<Vec2d>& stop : {by, std::optional<Vec2d>(p)}) {
      if (!stop) continue;
      const auto further = walk(map_.domain, walked.home, walked.at, inverse(motion)(*stop));
      if (!further) return std::nullopt;
      walked = *further;
      motion = composed(motion, walked.back);
    }
    return PlaceInFan{p, walked.home, walked.at, motion};
  }

  const WorkingMap& map_;
  const Fan& fan_;
  double angle_ = 0;  ///< of the whole fan, about its middle
};

}  // namespace

Fan lay_out_fan(const WorkingMap& map, Halfedge first, Halfedge last) {
  Fan fan;
  const auto image = [&](Halfedge h) { return map.chart[h](map.at[map.mesh.start(h)]); };
  fan.outline = {image(first), image(next_in_triangle(first))};
  UnitMotion motion;
  for (Halfedge out = first;; out = map.mesh.next_around(out)) {
    if (out != first) motion = composed(motion, motion_across(map, out));
    fan.outline.push_back(motion(image(previous_in_triangle(out))));
    fan.slices.push_back({out, motion});
    if (out == last) break;
  }
  return fan;
}

std::optional<PlaceInFan> find_place(const WorkingMap& map, const Fan& fan, const Vec2d& wanted) {
  return PlaceFinder(map, fan).find(wanted);
}

std::optional<PlaceInFan> find_place_on_boundary(const WorkingMap& map, const Fan& fan, Along way, double share) {
  const bool ahead = way == Along::kAhead;
  const Fan::Slice& slice = ahead ? fan.slices.front() : fan.slices.back();
  const Halfedge edge = ahead ? slice.spoke : previous_in_triangle(slice.spoke);
  const Vec2d to_neighbour = (ahead ? fan.outline[1] : fan.outline.back()) - fan.centre();
  const auto sees_all = [&](const Vec2d& p) {
    for (std::size_t i = 0; i < fan.outline.size(); ++i) {
      // The side that the place itself lies on.
      if (i == (ahead ? 0 : fan.outline.size() - 1)) continue;
      const Vec2d& q = fan.outline[i + 1 == fan.outline.size() ? 0 : i + 1];
      if (!(cross(fan.outline[i] - p, q - p) > 0)) return false;
    }
    return true;
  };
  for (; share > 1e-6; share /= 2) {
    const Vec2d p = fan.centre() + to_neighbour * share;
    if (!sees_all(p)) continue;
    const auto place = place_between(map, edge, ahead ? share : 1 - share);
    if (!place) return std::nullopt;
    return PlaceInFan{p, place->place.side.triangle, position_of(place->place),
                      composed(slice.into_fan, place->into_triangle)};
  }
  return std::nullopt;
}

Vec2d mean_of(const std::vector<Vec2d>& outline) {
  Vec2d sum(0, 0);
  for (const Vec2d& p : outline) sum += p;
  return sum / static_cast<double>(outline.size());
}

}  // namespace lozenge
