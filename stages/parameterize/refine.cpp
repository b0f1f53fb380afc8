#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "formats/error.h"
#include "stages/parameterize/global_optimization.h"
#include "stages/parameterize/levels.h"
#include "stages/parameterize/local_optimization.h"

namespace lozenge {

namespace {

/// Triangles around one vertex u, from one half-edge that leaves it to another, laid out flat in the frame of the first
/// of them: the hole that a removed vertex left, whose triangles all meet in the vertex it was collapsed into.
struct Fan {
  std::vector<Vec2d> outline;  ///< u, then the other corners counter-clockwise
  struct Slice {
    Halfedge spoke;       ///< leaves u
    UnitMotion into_fan;  ///< from the triangle's frame into the layout's
  };
  std::vector<Slice> slices;  ///< slice i lies between outline corners i + 1 and i + 2

  const Vec2d& centre() const { return outline.front(); }
};

constexpr double kPi = 3.14159265358979323846;

Vec2d times(const Vec2d& a, const Vec2d& b) { return {a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x}; }

Fan lay_out(const WorkingMap& map, Halfedge first, Halfedge last) {
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

/// The ring's mean with the weights that the vertex has in space (mean value coordinates, which are positive).
Vec2d mean_value_point(const WorkingMap& map, VertexId v, const std::vector<VertexId>& ring,
                       const std::vector<Vec2d>& outline) {
  const Vec3d centre((*map.positions)[v]);
  const std::size_t n = ring.size();
  std::vector<double> half_tangent(n);
  const auto direction = [&](std::size_t i) { return Vec3d((*map.positions)[ring[i % n]]) - centre; };
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3d p = direction(i), q = direction(i + 1);
    // tan(angle / 2) = sin / (1 + cos)
    const double lengths = p.length() * q.length();
    const double down = lengths + p.dot(q);
    half_tangent[i] = down > 1e-12 * lengths ? p.cross(q).length() / down : 0;
  }
  Vec2d sum(0, 0);
  double total = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const double length = direction(i).length();
    if (!(length > 0)) continue;
    const double weight = (half_tangent[i] + half_tangent[(i + n - 1) % n]) / length;
    sum += outline[i] * weight;
    total += weight;
  }
  return total > 0 ? sum / total : outline[0];
}

/// Where a vertex is to be put: in the fan's layout, and as a home with the motion from there into the layout.
struct Place {
  Vec2d in_fan;
  DomainTriangleId home = -1;
  Vec2d at;
  UnitMotion into_fan;
};

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
  std::optional<Place> find(const Vec2d& as_in_space) const {
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

  std::optional<Place> at(const Vec2d& p) const {
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
      const Halfedge beyond = previous_in_triangle(map_.mesh.twins[side]);
      const UnitMotion back = composed(slice.into_fan, motion_across(map_, map_.mesh.twins[side]));
      const auto image = [&](Halfedge h) { return slice.into_fan(map_.chart[h](map_.at[map_.mesh.start(h)])); };
      const Vec2d middle = (image(side) + image(next_in_triangle(side))) / 2;
      if (auto place = from_corner(beyond, back, middle, p)) return place;
    }
    return std::nullopt;
  }

  /// Walks from the start of `h`, whose triangle's frame `into_fan` takes into the layout, to p.
  std::optional<Place> from_corner(Halfedge h, const UnitMotion& into_fan, const std::optional<Vec2d>& by,
                                   const Vec2d& p) const {
    const VertexId w = map_.mesh.start(h);
    if (map_.pin[w] >= 0) return std::nullopt;
    UnitMotion motion = composed(into_fan, map_.chart[h]);
    Walked walked{map_.home[w], map_.at[w], {}};
    for (const std::optional<Vec2d>& stop : {by, std::optional<Vec2d>(p)}) {
      if (!stop) continue;
      const auto further = walk(map_.domain, walked.home, walked.at, inverse(motion)(*stop));
      if (!further) return std::nullopt;
      walked = *further;
      motion = composed(motion, walked.back);
    }
    return Place{p, walked.home, walked.at, motion};
  }

  const WorkingMap& map_;
  const Fan& fan_;
  double angle_ = 0;  ///< of the whole fan, about its middle
};

class Refinement {
 public:
  explicit Refinement(WorkingMap& map) : map_(map) {}

  /// \return false, with the vertex still removed, where it finds no place
  bool put_back(const Removal& removal) {
    HalfedgeMesh& mesh = map_.mesh;
    const Halfedge left = removal.halfedge;
    const Halfedge right = mesh.twins[left];
    const Halfedge first = mesh.twins[previous_in_triangle(left)];
    const Halfedge last = next_in_triangle(mesh.twins[next_in_triangle(right)]);
    const VertexId kept = mesh.start(first);
    const Fan hole = lay_out(map_, first, last);
    const Fan rest = lay_out(map_, mesh.next_around(last), previous_around(first));
    std::vector<VertexId> ring{kept};
    for (const Fan::Slice& slice : hole.slices) ring.push_back(mesh.end(slice.spoke));
    ring.push_back(mesh.opposite(last));
    const Vec2d as_in_space = mean_value_point(map_, removal.vertex, ring, hole.outline);
    if (const auto place = PlaceFinder(map_, hole).find(as_in_space)) {
      put_into(removal, hole, *place);
    } else if (!take_over(removal, kept, hole, rest)) {
      return false;
    }
    for_each_outgoing(mesh, removal.vertex, [&](Halfedge h) {
      map_.rest[h / 3] = rest_shape(*map_.positions, mesh.triangles[h / 3], map_.surface_area);
    });
    relax_vertex(map_, removal.vertex);
    return true;
  }

 private:
  Halfedge previous_around(Halfedge h) const { return next_in_triangle(map_.mesh.twins[h]); }

  /// Puts v into its hole. Its own two triangles take the frames of the hole's triangles beside them.
  void put_into(const Removal& removal, const Fan& hole, const Place& place) {
    const Halfedge left = removal.halfedge;
    const Halfedge right = map_.mesh.twins[left];
    const Halfedge first = hole.slices.front().spoke;
    const Halfedge last = hole.slices.back().spoke;
    const UnitMotion first_chart = inverse(hole.slices.front().into_fan);
    const UnitMotion last_chart = inverse(hole.slices.back().into_fan);
    set_charts(left, {composed(first_chart, place.into_fan), map_.chart[first], map_.chart[next_in_triangle(first)]});
    set_charts(right, {map_.chart[last], composed(last_chart, place.into_fan), map_.chart[previous_in_triangle(last)]});
    for (const Fan::Slice& slice : hole.slices) {
      map_.chart[slice.spoke] = composed(inverse(slice.into_fan), place.into_fan);
    }
    undo_removal(map_.mesh, removal);
    set_home(map_, removal.vertex, place.home, place.at);
  }

  /// Around a cone of more than a full turn a hole may be too wide for any point to see all of it but the cone itself.
  /// Then the vertex takes the place of u, the one pinned there, and u moves into the rest of what was around it.
  bool take_over(const Removal& removal, VertexId u, const Fan& hole, const Fan& rest) {
    const DomainVertex cone = map_.pin[u];
    if (cone < 0) return false;
    const auto place = PlaceFinder(map_, rest).find(mean_of(rest.outline));
    if (!place) return false;
    const auto w = barycentrics(map_.at[u]);
    const UnitPoint before{static_cast<std::int16_t>(w[1] > 0.5), static_cast<std::int16_t>(w[2] > 0.5)};
    const auto at_cone = [&](Halfedge spoke) {
      return chart_of_pinned(map_.corner_of[cone].corner, map_.chart[spoke](before));
    };
    const Halfedge left = removal.halfedge;
    const Halfedge right = map_.mesh.twins[left];
    const Halfedge first = rest.slices.front().spoke;
    const Halfedge last = rest.slices.back().spoke;
    const UnitMotion last_chart = composed(inverse(rest.slices.back().into_fan), place->into_fan);
    set_charts(left, {at_cone(last), last_chart, map_.chart[previous_in_triangle(last)]});
    set_charts(right, {place->into_fan, at_cone(first), map_.chart[next_in_triangle(first)]});
    for (const Fan::Slice& slice : hole.slices) map_.chart[slice.spoke] = at_cone(slice.spoke);
    for (const Fan::Slice& slice : rest.slices) {
      map_.chart[slice.spoke] = composed(inverse(slice.into_fan), place->into_fan);
    }
    undo_removal(map_.mesh, removal);
    unpin(map_, u);
    set_home(map_, u, place->home, place->at);
    pin_to(map_, removal.vertex, cone);
    return true;
  }

  /// Of the triangle of h, from its start on.
  void set_charts(Halfedge h, const std::array<UnitMotion, 3>& charts) {
    map_.chart[h] = charts[0];
    map_.chart[next_in_triangle(h)] = charts[1];
    map_.chart[previous_in_triangle(h)] = charts[2];
  }

  static Vec2d mean_of(const std::vector<Vec2d>& points) {
    Vec2d sum(0, 0);
    for (const Vec2d& p : points) sum += p;
    return sum / static_cast<double>(points.size());
  }

  WorkingMap& map_;
};

}  // namespace

void refine(WorkingMap& map, std::vector<Removal> removals, const RefineOptions& options, const Progress& progress) {
  Refinement refinement(map);
  const std::size_t coarse = map.mesh.outgoing.size() - removals.size();
  const std::size_t all = map.mesh.outgoing.size();
  std::size_t there = coarse;
  while (!removals.empty()) {
    const auto level = std::min(all, static_cast<std::size_t>(static_cast<double>(there) * options.level_growth) + 1);
    for (; there < level; ++there) {
      if (!refinement.put_back(removals.back())) {
        throw Error(ExitCode::kInternal,
                    "vertex " + std::to_string(removals.back().vertex) + " finds no place in the map");
      }
      removals.pop_back();
    }
    measure_rest_shapes(map);
    relax(map, vertices_by_triangle(map), {options.sweeps, 1e-3});
    report(progress, "bringing the map to the mesh", static_cast<double>(there) / static_cast<double>(all));
  }
}

}  // namespace lozenge
