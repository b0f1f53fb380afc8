// Equation (5) walks along mesh edges on both sides of the path: wherever a mesh triangle has one corner on one side of
// the path and two on the other, the edge between the two counts with its length in space, times the cosine, on the
// domain, of its angle to the path. Both sides are counted, hence the half. The same walk along the diamond's long
// diagonal measures the path that a flip would make; there the sides are the halves of the diamond left and right of
// the diagonal.
#include "stages/parameterize/map/path_lengths.h"

#include <algorithm>
#include <cmath>

#include "stages/parameterize/map/boundary.h"
#include "stages/parameterize/map/images.h"

namespace lozenge {

namespace {

double blend(double measured, double embedded, double h) {
  const double weight = std::min(1.0, h / kWarmVertices);
  return measured * weight + embedded * (1 - weight);
}

int count_vertices(const WorkingMap& map, DomainTriangleId t, int enough) {
  int count = 0;
  for (VertexId v = map.first_in[t]; v >= 0 && count < enough; v = map.next_in[v]) ++count;
  return count;
}

double embedded_distance(const SurfaceMeasures& m, DomainVertex a, DomainVertex b) {
  return (m.embedding[a] - m.embedding[b]).length();
}

/// A line through the diamond's frame, along which a path runs.
struct Line {
  Vec2d through;
  Vec2d direction;  ///< of length 1
  double from, to;  ///< the path's ends along it

  bool is_left(const Vec2d& p) const { return cross(direction, p - through) > 0; }
  /// How far along, cut to the path's ends.
  double along(const Vec2d& p) const { return std::clamp(direction.dot(p - through), from, to); }
};

/// The sum of (5) over the source triangles whose corners lie on both sides of the line, visiting those around the
/// vertices at home in both triangles of the diamond.
double measure_path(const WorkingMap& map, DomainSide side, const Line& line) {
  const DomainSide across = map.domain.neighbour(side);
  const UnitMotion& motion = unit_transition(side.side, across.side);
  const auto position = [&](VertexId v, Vec2d& p) {
    if (map.home[v] == side.triangle) p = map.at[v];
    else if (map.home[v] == across.triangle) p = motion(map.at[v]);
    else return false;
    return true;
  };
  double sum = 0;
  for (const DomainTriangleId region : {side.triangle, across.triangle}) {
    for (VertexId v = map.first_in[region]; v >= 0; v = map.next_in[v]) {
      for_each_outgoing(map.mesh, v, [&](Halfedge h) {
        // The edge opposite v counts where v is alone on its side.
        const VertexId u = map.mesh.end(h);
        const VertexId w = map.mesh.opposite(h);
        Vec2d p, q, r;
        if (!position(v, p) || !position(u, q) || !position(w, r)) return;
        if (line.is_left(q) != line.is_left(r) || line.is_left(p) == line.is_left(q)) return;
        const Vec2d e = r - q;
        const double length = e.length();
        if (length <= 0) return;
        const double in_space = Vec3d((*map.positions)[u] - (*map.positions)[w]).length();
        sum += in_space * std::abs(line.along(r) - line.along(q)) / length;
      });
    }
  }
  return sum / 2;
}

double warmth(const WorkingMap& map, DomainSide side) {
  const DomainSide across = map.domain.neighbour(side);
  const int here = count_vertices(map, side.triangle, kWarmVertices);
  return across.exists() ? std::min(here, count_vertices(map, across.triangle, kWarmVertices)) : here;
}

/// The length in space of a source edge on the boundary, as far as its image lies on the side; `from` is where its
/// start lies along the side, which may be before it.
double length_on_side(const WorkingMap& map, Halfedge edge, double from) {
  const double length =
      (image_of_corner(map, edge / 3, next_in_triangle(edge) % 3) - image_of_corner(map, edge / 3, edge % 3)).length();
  if (!(length > 0)) return 0;
  const auto& positions = *map.positions;
  const double in_space = Vec3d(positions[map.mesh.end(edge)] - positions[map.mesh.start(edge)]).length();
  return in_space * (std::clamp(from + length, 0.0, 1.0) - std::clamp(from, 0.0, 1.0)) / length;
}

/// On the boundary the path is the surface's own edge.
double measure_boundary(const WorkingMap& map, DomainSide side) {
  struct Stop {
    double along;
    VertexId vertex;
    bool operator<(const Stop& other) const { return along < other.along; }
  };
  std::vector<Stop> stops;
  for (VertexId v = map.first_in[side.triangle]; v >= 0; v = map.next_in[v]) {
    if (map.pin[v] >= 0 || !map.mesh.on_boundary(v)) continue;
    const BoundaryPlace place = boundary_place(map, v);
    if (place.side == side) stops.push_back({place.along, v});
  }
  if (stops.empty()) return std::sqrt(map.surface_area / (map.domain_faces * 0.5 * kHalfRoot3));
  double sum = 0;
  for (const Stop& stop : stops) sum += length_on_side(map, leaving_on_boundary(map.mesh, stop.vertex), stop.along);
  const Stop& first = *std::min_element(stops.begin(), stops.end());
  const Halfedge arriving = arriving_on_boundary(map.mesh, first.vertex);
  const double length = (image_of_corner(map, arriving / 3, next_in_triangle(arriving) % 3) -
                         image_of_corner(map, arriving / 3, arriving % 3))
                            .length();
  return sum + length_on_side(map, arriving, first.along - length);
}

}  // namespace

std::vector<float> voronoi_areas(const WorkingMap& map) {
  std::vector<float> areas(map.mesh.outgoing.size(), 0);
  for (const auto& t : map.mesh.triangles) {
    if (t[0] < 0) continue;
    const std::array<Vec3d, 3> p{Vec3d((*map.positions)[t[0]]), Vec3d((*map.positions)[t[1]]),
                                 Vec3d((*map.positions)[t[2]])};
    const double doubled = (p[1] - p[0]).cross(p[2] - p[0]).length();
    if (!(doubled > 0)) continue;
    std::array<double, 3> cotangent{};
    int obtuse = -1;
    for (int i = 0; i < 3; ++i) {
      cotangent[i] = (p[(i + 1) % 3] - p[i]).dot(p[(i + 2) % 3] - p[i]) / doubled;
      if (cotangent[i] < 0) obtuse = i;
    }
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3;
      const int k = (i + 2) % 3;
      double area = (cotangent[j] * (p[k] - p[i]).length2() + cotangent[k] * (p[j] - p[i]).length2()) / 8;
      if (obtuse >= 0) area = doubled / (obtuse == i ? 4 : 8);
      areas[t[i]] += static_cast<float>(area);
    }
  }
  return areas;
}

double region_area(const WorkingMap& map, const SurfaceMeasures& measures, DomainTriangleId t) {
  double measured = 0;
  int count = 0;
  for (VertexId v = map.first_in[t]; v >= 0; v = map.next_in[v]) {
    measured += measures.vertex_area[v];
    ++count;
  }
  if (!measures.warming_up || count >= kWarmVertices) return measured;
  const auto& c = map.domain.triangles[t].corners;
  const Vec3d a = measures.embedding[c[0]];
  return blend(measured, (measures.embedding[c[1]] - a).cross(measures.embedding[c[2]] - a).length() / 2, count);
}

double path_length(const WorkingMap& map, const SurfaceMeasures& measures, DomainSide side) {
  const double h = measures.warming_up ? warmth(map, side) : kWarmVertices;
  const double embedded =
      h < kWarmVertices ? embedded_distance(measures, map.domain.start(side), map.domain.end(side)) : 0;
  if (h == 0) return embedded;
  if (!map.domain.neighbour(side).exists()) return blend(measure_boundary(map, side), embedded, h);
  const Vec2d a = corner_position(side.side);
  const Vec2d b = corner_position((side.side + 1) % 3);
  return blend(measure_path(map, side, {a, b - a, 0, 1}), embedded, h);
}

double flipped_path_length(const WorkingMap& map, const SurfaceMeasures& measures, DomainSide side) {
  const DomainSide across = map.domain.neighbour(side);
  const double h = measures.warming_up ? warmth(map, side) : kWarmVertices;
  const DomainVertex c = map.domain.corner(side.triangle, (side.side + 2) % 3);
  const DomainVertex d = map.domain.corner(across.triangle, (across.side + 2) % 3);
  const double embedded = h < kWarmVertices ? embedded_distance(measures, c, d) : 0;
  if (h == 0) return embedded;
  const Vec2d from = corner_position((side.side + 2) % 3);
  const Vec2d to = unit_transition(side.side, across.side)(corner_position((across.side + 2) % 3));
  const double length = (to - from).length();
  return blend(measure_path(map, side, {from, (to - from) / length, 0, length}), embedded, h);
}

}  // namespace lozenge
