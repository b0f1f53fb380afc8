#include "stages/parameterize/relax/star_embedding.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "stages/parameterize/map/homes.h"
#include "stages/parameterize/map/marks.h"
#include "stages/parameterize/map/pins.h"
#include "stages/parameterize/map/star.h"

namespace lozenge {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The polygon's slices when they meet in another centre.
class Slices {
 public:
  Slices(const StarPolygon& polygon, const Vec2d& centre) : centre_(centre) {
    for (int i = 0; i < polygon.slices; ++i) {
      const Vec2d a = polygon.corner(i) - centre;
      const Vec2d b = polygon.corner(i + 1) - centre;
      slices_.push_back({a, b, 1 / cross(a, b)});
    }
  }

  /// Where a point of the diameter lies: on the first side that leaves the centre, or on the last.
  StarSlice find_on_diameter(const Vec2d& p) const {
    const double x = p.x - centre_.x;
    if (x >= 0) return {0, std::min(x / slices_.front().first.x, 1.0), 0};
    return {static_cast<int>(slices_.size()) - 1, 0, std::min(x / slices_.back().second.x, 1.0)};
  }

  /// Where a point of the polygon lies.
  StarSlice find(const Vec2d& p) const {
    return find_in(p, [](int) { return true; });
  }

  /// Where a point of the polygon's rim lies that the surface's boundary runs through: on one of the rim's sides that
  /// have no neighbour. \return nothing where there is no such side
  template <typename HasNeighbour>
  std::optional<StarSlice> find_on_rim(const Vec2d& p, const HasNeighbour& has_neighbour) const {
    StarSlice w = find_in(p, [&](int slice) { return !has_neighbour(slice); });
    if (has_neighbour(w.slice)) return std::nullopt;
    const double sum = w.first + w.second;
    if (!(sum > 0)) return std::nullopt;
    w.first /= sum;
    w.second /= sum;
    return w;
  }

 private:
  /// Of some slices, where the point lies, or lies beside.
  template <typename IsWanted>
  StarSlice find_in(const Vec2d& p, const IsWanted& is_wanted) const {
    StarSlice best;
    double least = -kInfinity;
    const Vec2d q = p - centre_;
    for (std::size_t i = 0; i < slices_.size() && least < 0; ++i) {
      const Slice& s = slices_[i];
      if (!is_wanted(static_cast<int>(i))) continue;
      const StarSlice here{static_cast<int>(i), cross(q, s.second) * s.inverse_area,
                           cross(s.first, q) * s.inverse_area};
      const double inside = std::min(here.first, here.second);
      if (inside > least) {
        least = inside;
        best = here;
      }
    }
    // Rounding may put a point a hair outside.
    best.first = std::max(best.first, 0.0);
    best.second = std::max(best.second, 0.0);
    if (const double sum = best.first + best.second; sum > 1) {
      best.first /= sum;
      best.second /= sum;
    }
    return best;
  }

  struct Slice {
    Vec2d first, second;  ///< corners, from the centre
    double inverse_area;
  };
  Vec2d centre_;
  std::vector<Slice> slices_;
};

/// Seen from the centre, the polygon's slices in which a layout lies, and its charts.
class SliceCharts {
 public:
  SliceCharts(WorkingMap& map, const std::vector<DomainCorner>& star, const Vec2d& centre)
      : map_(map), star_(star), polygon_(polygon_of(map, star)), centre_(centre) {}

  /// A corner of a source triangle, as the polygon has it.
  struct Place {
    int slice = 0;
    Vec2d at;                ///< relative to the centre
    bool at_centre = false;  ///< pinned there
    int rim = 0;             ///< pinned to the rim: 1, to the slice's first corner; 2, to its second
  };

  /// A vertex pinned to the rim.
  Place on_rim(DomainVertex n) const {
    Place p;
    for (int m = 0; m < polygon_.slices; ++m) {
      for (int rim = 1; rim < 3; ++rim) {
        // Of a polygon that goes around, each corner is some slice's first.
        if (rim == 2 && !polygon_.is_half) continue;
        if (map_.domain.corner(star_[m].triangle, (star_[m].corner + rim) % 3) != n) continue;
        p.slice = m;
        p.rim = rim;
      }
    }
    p.at = polygon_.corner(p.slice + p.rim - 1) - centre_;
    return p;
  }

  /// From the frame of the slice of `p` into that of the slice of `q`, the way that the straight line between them
  /// takes around the centre.
  UnitMotion between(const Place& p, const Place& q) const {
    const int corner = star_[q.slice].corner;
    const UnitMotion& into = to_corner_frame(star_[p.slice].corner);
    return composed(from_corner_frame(corner), composed(rotation(-slots(p, q)), into));
  }

  /// Of a triangle that hangs on a gate: all corners inside go through it.
  void chart_through(const Hanging& h, int corner, const Place& p) {
    const DomainSide inner = map_.domain.neighbour(h.gate.outer);
    Place gate;
    for (int m = 0; m < polygon_.slices; ++m) {
      if (star_[m].triangle == inner.triangle) gate.slice = m;
    }
    // The outer side runs against the slice's.
    gate.at = polygon_.corner(gate.slice + 1) * (1 - h.gate.share) + polygon_.corner(gate.slice) * h.gate.share;
    gate.at -= centre_;
    set(h.triangle, corner, p, gate, chart_inside(map_, h.gate));
  }

  /// Of a triangle inside: the first corner's slice gives it its frame.
  void chart_inside_of(TriangleId t, const std::array<Place, 3>& places) {
    int reference = 0;
    while (reference < 2 && (places[reference].at_centre || places[reference].rim > 0)) ++reference;
    if (places[reference].at_centre) reference = (reference + 1) % 3;
    for (int c = 0; c < 3; ++c) set(t, c, places[c], places[reference], {});
  }

 private:
  /// By how many slices the line from p to q turns about the centre, counter-clockwise.
  int slots(const Place& p, const Place& q) const {
    constexpr double kBeside = 0.1;  // tangent: the nearer to each other, the fewer slices are right
    if (polygon_.is_half) return q.slice - p.slice;
    const int count = polygon_.slices;
    const int forth = (q.slice - p.slice + count) % count;
    if (forth == 0) return 0;
    const double left = cross(p.at, q.at);
    const bool beside = std::abs(left) < kBeside * p.at.dot(q.at);
    const bool forward = beside ? 2 * forth <= count : left >= 0;
    return forward ? forth : forth - count;
  }

  /// The chart of a corner, where `chart` takes the frame of the slice of `reference` into the triangle's.
  void set(TriangleId t, int corner, const Place& p, const Place& reference, const UnitMotion& chart) {
    UnitMotion& mine = map_.chart[3 * t + corner];
    const VertexId v = map_.mesh.triangles[t][corner];
    if (p.at_centre) {
      mine = chart_of_pinned(corner_of_pinned(map_, v), chart(corner_step(star_[reference.slice].corner)));
    } else if (p.rim > 0) {
      const int corner_there = (star_[p.slice].corner + p.rim) % 3;
      mine =
          chart_of_pinned(corner_of_pinned(map_, v), composed(chart, between(p, reference))(corner_step(corner_there)));
    } else {
      mine = composed(chart, between(p, reference));
    }
  }

  WorkingMap& map_;
  const std::vector<DomainCorner>& star_;
  StarPolygon polygon_;
  Vec2d centre_;
};

thread_local Numbering number_in_layout;

void number(const WorkingMap& map, const StarLayout& layout) {
  number_in_layout.clear(map.home.size());
  for (std::size_t i = 0; i < layout.vertices.size(); ++i) {
    number_in_layout.set(layout.vertices[i], static_cast<std::int32_t>(i));
  }
}

/// Gives the triangles around a layout, whose vertices are in these slices, their charts.
void make_charts(WorkingMap& map, const std::vector<DomainCorner>& star, const StarLayout& layout,
                 const std::vector<int>& slices, const std::vector<Hanging>& hanging, const Vec2d& centre,
                 VertexId anchor) {
  using Place = SliceCharts::Place;
  SliceCharts charts(map, star, centre);
  number(map, layout);
  const auto place_of = [&](VertexId v) {
    const std::int32_t i = number_in_layout.find(v);
    if (i >= 0) return Place{slices[i], layout.at[i] - centre, v == anchor, 0};
    return charts.on_rim(map.pin[v]);
  };
  for (const Hanging& h : hanging) {
    const auto& t = map.mesh.triangles[h.triangle];
    if (h.is_inside()) {
      charts.chart_inside_of(h.triangle, {place_of(t[0]), place_of(t[1]), place_of(t[2])});
      continue;
    }
    for (int c = 0; c < 3; ++c) {
      if (number_in_layout.find(t[c]) >= 0) charts.chart_through(h, c, place_of(t[c]));
    }
  }
}

}  // namespace

Region region_of(const WorkingMap& map, const std::vector<DomainCorner>& star, const StarLayout& layout) {
  Region region;
  region.moving = layout.vertices;
  for (const DomainCorner& c : star) {
    region.triangles.push_back(c.triangle);
    region.rim.push_back(map.domain.corner(c.triangle, (c.corner + 1) % 3));
  }
  const DomainCorner& last = star.back();
  if (polygon_of(map, star).is_half) region.rim.push_back(map.domain.corner(last.triangle, (last.corner + 2) % 3));
  return region;
}

void keep_layout(Checkpoint& checkpoint, DomainVertex n, const StarLayout& layout,
                 const std::vector<Hanging>& hanging) {
  checkpoint.keep_domain_vertex(n);
  for (const VertexId v : layout.vertices) checkpoint.keep_vertex(v);
  for (const Hanging& h : hanging) checkpoint.keep_charts(h.triangle);
}

StarPolygon polygon_of(const WorkingMap& map, const std::vector<DomainCorner>& star) {
  return {static_cast<int>(star.size()), next_around(map.domain, star.back()).triangle < 0};
}

bool may_be_centre(const WorkingMap& map, const StarPolygon& polygon, const StarLayout& layout, std::size_t place) {
  return map.mesh.on_boundary(layout.vertices[place]) == polygon.is_half &&
         (!polygon.is_half || polygon.is_on_diameter(layout.at[place]));
}

std::vector<std::size_t> nearest_in_layout(const WorkingMap& map, const StarPolygon& polygon, const StarLayout& layout,
                                           const Vec2d& p, std::size_t most) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < layout.vertices.size(); ++i) {
    if (may_be_centre(map, polygon, layout, i)) order.push_back(i);
  }
  const std::size_t count = std::min(most, order.size());
  std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(count), order.end(),
                    [&](std::size_t i, std::size_t j) {
                      const double a = (layout.at[i] - p).length2();
                      const double b = (layout.at[j] - p).length2();
                      return a != b ? a < b : layout.vertices[i] < layout.vertices[j];
                    });
  order.resize(count);
  return order;
}

StarLayout lay_out_star(const WorkingMap& map, const std::vector<DomainCorner>& star, StarShape shape) {
  StarLayout layout;
  const StarPolygon polygon = polygon_of(map, star);
  const DomainVertex n = map.domain.corner(star.front().triangle, star.front().corner);
  for (int slice = 0; slice < polygon.slices; ++slice) {
    const DomainCorner c = star[slice];
    for (VertexId v = map.first_in[c.triangle]; v >= 0; v = map.next_in[v]) {
      if (map.pin[v] >= 0) continue;
      const auto w = barycentrics(map.at[v]);
      layout.vertices.push_back(v);
      layout.at.push_back(polygon.point({slice, w[(c.corner + 1) % 3], w[(c.corner + 2) % 3]}, shape));
    }
  }
  if (const VertexId v = map.anchor[n]; v >= 0) {
    layout.vertices.push_back(v);
    layout.at.push_back(Vec2d(0, 0));
  }
  return layout;
}

bool embed_star(WorkingMap& map, DomainVertex n, const StarLayout& layout, const std::vector<Hanging>& hanging,
                const Vec2d& centre, VertexId anchor, const RelaxOptions& options) {
  const std::vector<DomainCorner> star = star_of(map, n);
  const StarPolygon polygon = polygon_of(map, star);
  if (const VertexId old = map.anchor[n]; old >= 0) unpin(map, old);
  std::vector<int> slices(layout.vertices.size(), 0);
  const Slices slices_around(polygon, centre);
  const auto has_neighbour = [&](int slice) {
    return map.domain.neighbour({star[slice].triangle, (star[slice].corner + 1) % 3}).exists();
  };
  const auto find = [&](VertexId v, const Vec2d& at) -> std::optional<StarSlice> {
    if (!map.mesh.on_boundary(v)) return slices_around.find(at);
    if (polygon.is_on_diameter(at)) return slices_around.find_on_diameter(at);
    return slices_around.find_on_rim(at, has_neighbour);
  };
  for (std::size_t i = 0; i < layout.vertices.size(); ++i) {
    const VertexId v = layout.vertices[i];
    if (v == anchor) continue;
    const auto w = find(v, layout.at[i]);
    if (!w) return false;
    const DomainCorner c = star[w->slice];
    slices[i] = w->slice;
    set_home(map, v, c.triangle, from_corner_frame(c.corner)(at_barycentrics(w->first, w->second)));
  }
  if (anchor >= 0) pin_to(map, anchor, n);
  make_charts(map, star, layout, slices, hanging, centre, anchor);
  if (!heal_folds(map, layout.vertices) || !are_consistent(map, hanging)) return false;
  relax(map, layout.vertices, options);
  return true;
}

bool ensure_anchor(WorkingMap& map, DomainVertex n) {
  if (map.anchor[n] >= 0) return true;
  const std::vector<DomainCorner> star = star_of(map, n);
  const StarLayout layout = lay_out_star(map, star, {});
  std::vector<Hanging> hanging;
  if (!find_surroundings(map, region_of(map, star, layout), hanging)) return false;
  for (const std::size_t i : nearest_in_layout(map, polygon_of(map, star), layout, {0, 0}, 3)) {
    Checkpoint checkpoint(map);
    keep_layout(checkpoint, n, layout, hanging);
    if (embed_star(map, n, layout, hanging, layout.at[i], layout.vertices[i], {2, 0})) return true;
    checkpoint.restore();
  }
  return false;
}

}  // namespace lozenge
