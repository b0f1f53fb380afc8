// Two corners of one triangle see each other along a straight line through the polygon. It turns about the centre by
// some slices, each of which is a sixth of a turn on the domain: that is the motion between their homes.
#include "stages/parameterize/relax/slice_charts.h"

#include <array>
#include <cmath>

#include "stages/parameterize/map/pins.h"

namespace lozenge {

namespace {

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
  void chart_through(const MovingTriangle& m, int corner, const Place& p) {
    const DomainSide inner = map_.domain.neighbour(m.gate.outer);
    Place gate;
    for (int slice = 0; slice < polygon_.slices; ++slice) {
      if (star_[slice].triangle == inner.triangle) gate.slice = slice;
    }
    // The outer side runs against the slice's.
    gate.at = polygon_.corner(gate.slice + 1) * (1 - m.gate.share) + polygon_.corner(gate.slice) * m.gate.share;
    gate.at -= centre_;
    set(m.triangle, corner, p, gate, chart_inside(map_, m.gate));
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

}  // namespace

void make_star_charts(WorkingMap& map, const std::vector<DomainCorner>& star, const StarLayout& layout,
                      const std::vector<int>& slices, const std::vector<MovingTriangle>& surroundings,
                      const Vec2d& centre, VertexId anchor, Numbering& places) {
  using Place = SliceCharts::Place;
  SliceCharts charts(map, star, centre);
  places.clear(map.home.size());
  for (std::size_t i = 0; i < layout.vertices.size(); ++i) {
    places.set(layout.vertices[i], static_cast<std::int32_t>(i));
  }
  const auto place_of = [&](VertexId v) {
    const std::int32_t i = places.find(v);
    if (i >= 0) return Place{slices[i], layout.at[i] - centre, v == anchor, 0};
    return charts.on_rim(map.pin[v]);
  };
  for (const MovingTriangle& m : surroundings) {
    const auto& t = map.mesh.triangles[m.triangle];
    if (m.is_inside()) {
      charts.chart_inside_of(m.triangle, {place_of(t[0]), place_of(t[1]), place_of(t[2])});
      continue;
    }
    for (int c = 0; c < 3; ++c) {
      if (places.find(t[c]) >= 0) charts.chart_through(m, c, place_of(t[c]));
    }
  }
}

}  // namespace lozenge
