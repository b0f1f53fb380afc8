#include "stages/parameterize/map/working_map.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "formats/base/parallel.h"
#include "formats/domain/development.h"
#include "stages/parameterize/map/boundary.h"

namespace lozenge {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Two images of one edge differ by rounding alone.
constexpr double kSame = 1e-9;

double squared_distance(const Vec2d& a, const Vec2d& b) { return (a - b).length2(); }

/// The chart of a corner of an exact image: the motion, along some short way from the frame of the image to the
/// corner's home, that takes the point to where the image has it.
std::optional<UnitMotion> chart_of_image(const Domain& domain, const DomainPoint& p, DomainTriangleId frame,
                                         LatticePoint image) {
  struct Reached {
    DomainTriangleId triangle;
    LatticeMotion motion;
  };
  constexpr int kDepth = 4;
  std::vector<Reached> reached{{frame, {}}};
  for (std::size_t first = 0, depth = 0; depth <= kDepth; ++depth) {
    const std::size_t last = reached.size();
    for (; first < last; ++first) {
      const Reached here = reached[first];
      if (here.triangle == p.triangle && here.motion(lattice_point(p)) == image) {
        const auto steps = [](std::int64_t x) { return static_cast<std::int16_t>(x / kLatticeOne); };
        return UnitMotion{static_cast<std::int16_t>(here.motion.sixths),
                          {steps(here.motion.shift.u), steps(here.motion.shift.v)}};
      }
      for (int s = 0; s < 3; ++s) {
        const DomainSide n = domain.neighbour({here.triangle, s});
        if (n.exists()) reached.push_back({n.triangle, composed(here.motion, transition(s, n.side))});
      }
    }
  }
  return std::nullopt;
}

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
    return squared_distance(end_seen_from_start(map, h)(map.at[w]), there(map.at[w])) < kSame;
  }
  if (w_free) {
    const UnitMotion here = composed(inverse(map.chart[next_in_triangle(h)]), map.chart[h]);
    return squared_distance(here(map.at[v]), end_seen_from_start(map, g)(map.at[v])) < kSame;
  }
  const double here = squared_distance(map.chart[h](map.at[v]), map.chart[next_in_triangle(h)](map.at[w]));
  const double there = squared_distance(map.chart[g](map.at[w]), map.chart[next_in_triangle(g)](map.at[v]));
  return std::abs(here - there) < kSame;
}

/// The corner of triangle `home` that lies at a point and belongs to a domain vertex, or -1.
int corner_there(const Domain& domain, DomainTriangleId home, const Vec2d& at, DomainVertex n) {
  for (int c = 0; c < 3; ++c) {
    if (domain.corner(home, c) == n && squared_distance(at, corner_position(c)) < kSame) return c;
  }
  return -1;
}

/// `seen` takes the frame of `home` into that of `walked`: whether they are one triangle, or two with the point on the
/// side between them.
bool is_same_place(const Domain& domain, const Walked& walked, DomainTriangleId home, const UnitMotion& seen) {
  if (walked.home == home) return seen == UnitMotion{};
  const auto w = barycentrics(walked.at);
  for (int s = 0; s < 3; ++s) {
    const DomainSide n = domain.neighbour({walked.home, s});
    if (n.triangle == home && std::abs(w[(s + 2) % 3]) < kSame && unit_transition(s, n.side) == seen) return true;
  }
  return false;
}

/// A walk along several lines, one after the other; all stops in the frame of the start.
std::optional<Walked> walk_along(const Domain& domain, Walked place, const std::array<Vec2d, 3>& stops) {
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
  const auto is_there = [&](const std::optional<Walked>& walked) {
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

/// The nearest point on the lattice that lies on the side.
DomainPoint point_on_side(DomainSide side, double along) {
  const std::int64_t steps = std::llround(std::clamp(along, 0.0, 1.0) * static_cast<double>(kLatticeOne));
  std::array<std::int64_t, 3> weights{};
  weights[side.side] = kLatticeOne - steps;
  weights[(side.side + 1) % 3] = steps;
  return domain_point(side.triangle, {weights[1], weights[2]});
}

}  // namespace

void measure_rest_shapes(WorkingMap& map) {
  const std::size_t count = map.mesh.triangles.size();
  map.surface_area = sum_of_parts(count, [&](std::size_t begin, std::size_t end) {
    double area = 0;
    for (std::size_t t = begin; t < end; ++t) {
      if (map.mesh.triangles[t][0] >= 0) area += triangle_area(*map.positions, map.mesh.triangles[t]);
    }
    return area;
  });
  map.rest.resize(count);
  for_each_part(count, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) {
      const auto& corners = map.mesh.triangles[t];
      if (corners[0] >= 0) map.rest[t] = rest_shape(*map.positions, corners, map.surface_area, map.flattest);
    }
  });
}

void put_vertices_nowhere(WorkingMap& map) {
  const std::size_t vertices = map.mesh.outgoing.size();
  map.home.assign(vertices, -1);
  map.at.assign(vertices, Vec2d(0, 0));
  map.pin.assign(vertices, -1);
  map.next_in.assign(vertices, -1);
  map.last_in.assign(vertices, -1);
}

void list_homes(WorkingMap& map) {
  map.first_in.assign(map.domain.triangles.size(), -1);
  map.next_in.assign(map.home.size(), -1);
  map.last_in.assign(map.home.size(), -1);
  map.listed = true;
  for (VertexId v = 0; v < map.mesh.vertex_count(); ++v) {
    const DomainTriangleId home = map.home[v];
    if (home < 0) continue;
    map.home[v] = -1;
    set_home(map, v, home, map.at[v]);
  }
}

std::vector<VertexId> vertices_by_triangle(const WorkingMap& map) {
  std::vector<VertexId> vertices;
  vertices.reserve(map.home.size());
  for (const VertexId first : map.first_in) {
    for (VertexId v = first; v >= 0; v = map.next_in[v]) vertices.push_back(v);
  }
  return vertices;
}

WorkingMap trivial_map(const std::vector<Vec3f>& positions, HalfedgeMesh mesh, double flattest) {
  WorkingMap map;
  map.flattest = flattest;
  map.positions = &positions;
  map.mesh = std::move(mesh);
  measure_rest_shapes(map);
  put_vertices_nowhere(map);
  const std::size_t vertices = map.home.size();

  // Domain triangles and vertices are numbered without the gaps that removed source triangles leave.
  std::vector<DomainTriangleId> number(map.mesh.triangles.size(), -1);
  for (std::size_t t = 0; t < number.size(); ++t) {
    if (map.mesh.triangles[t][0] >= 0) number[t] = map.domain_faces++;
  }
  std::vector<DomainVertex> vertex_number(vertices, -1);
  for (std::size_t v = 0; v < vertices; ++v) {
    if (map.mesh.outgoing[v] >= 0) vertex_number[v] = map.domain.vertex_count++;
  }
  map.domain.triangles.resize(map.domain_faces);
  map.first_in.assign(map.domain_faces, -1);
  map.corner_of.assign(map.domain.vertex_count, {});
  map.anchor.assign(map.domain.vertex_count, -1);
  map.kept.assign(map.domain.vertex_count, 0);
  for (std::size_t t = 0; t < number.size(); ++t) {
    if (number[t] < 0) continue;
    DomainTriangle& d = map.domain.triangles[number[t]];
    for (int s = 0; s < 3; ++s) {
      d.corners[s] = vertex_number[map.mesh.triangles[t][s]];
      map.corner_of[d.corners[s]] = {number[t], s};
      const Halfedge twin = map.mesh.twins[3 * t + s];
      if (twin >= 0) d.neighbours[s] = {number[twin / 3], twin % 3};
    }
  }
  for (VertexId v = 0; v < map.mesh.vertex_count(); ++v) {
    if (vertex_number[v] >= 0) pin_to(map, v, vertex_number[v]);
  }
  map.chart.resize(map.mesh.twins.size());
  for (std::size_t t = 0; t < number.size(); ++t) {
    for (int s = 0; s < 3 && number[t] >= 0; ++s) {
      const DomainVertex n = vertex_number[map.mesh.triangles[t][s]];
      map.chart[3 * t + s] = chart_of_pinned(map.corner_of[n].corner, corner_step(s));
    }
  }
  return map;
}

WorkingMap working_map(const SourceMesh& mesh, const Parameterization& finished_map) {
  WorkingMap map;
  map.positions = &mesh.positions;
  const std::size_t vertices = mesh.positions.size();
  map.mesh = make_halfedge_mesh(mesh.triangles, static_cast<std::int32_t>(vertices));
  measure_rest_shapes(map);
  map.domain = finished_map.domain;
  map.domain_faces = map.domain.size();
  map.corner_of = corner_of_each_vertex(map.domain);
  map.anchor.assign(map.corner_of.size(), -1);
  map.kept.assign(map.corner_of.size(), 0);
  map.first_in.assign(map.domain.triangles.size(), -1);
  put_vertices_nowhere(map);
  for (VertexId v = 0; v < static_cast<VertexId>(vertices); ++v) {
    const DomainPoint& p = finished_map.phi[v];
    if (const DomainVertex corner = vertex_at(map.domain, p); corner >= 0) pin_to(map, v, corner);
    else set_home(map, v, p.triangle, at_barycentrics(p.beta, p.gamma()));
  }
  map.chart.resize(map.mesh.twins.size());
  for (TriangleId t = 0; t < map.mesh.triangle_count(); ++t) {
    const auto image = image_of(mesh, finished_map, t);
    for (int c = 0; c < 3 && image; ++c) {
      const VertexId v = map.mesh.triangles[t][c];
      if (map.pin[v] >= 0) {
        const LatticePoint p = image->corners[c];
        const UnitPoint step{static_cast<std::int16_t>(p.u / kLatticeOne),
                             static_cast<std::int16_t>(p.v / kLatticeOne)};
        map.chart[3 * t + c] = chart_of_pinned(map.corner_of[map.pin[v]].corner, step);
      } else if (const auto chart = chart_of_image(map.domain, finished_map.phi[v], image->home, image->corners[c])) {
        map.chart[3 * t + c] = *chart;
      }
    }
  }
  return map;
}

void set_home(WorkingMap& map, VertexId v, DomainTriangleId home, const Vec2d& at) {
  map.at[v] = at;
  if (map.home[v] == home) return;
  if (!map.listed) {
    map.home[v] = home;
    return;
  }
  if (map.home[v] >= 0) {
    const VertexId before = map.last_in[v];
    const VertexId after = map.next_in[v];
    (before >= 0 ? map.next_in[before] : map.first_in[map.home[v]]) = after;
    if (after >= 0) map.last_in[after] = before;
  }
  map.home[v] = home;
  map.last_in[v] = -1;
  map.next_in[v] = -1;
  if (home < 0) return;
  map.next_in[v] = map.first_in[home];
  if (map.first_in[home] >= 0) map.last_in[map.first_in[home]] = v;
  map.first_in[home] = v;
}

void move_home(WorkingMap& map, VertexId v, DomainTriangleId home, const Vec2d& at, const UnitMotion& back) {
  set_home(map, v, home, at);
  for_each_outgoing(map.mesh, v, [&](Halfedge h) { map.chart[h] = composed(map.chart[h], back); });
}

void pin_to(WorkingMap& map, VertexId v, DomainVertex corner) {
  const DomainCorner c = map.corner_of[corner];
  set_home(map, v, c.triangle, corner_position(c.corner));
  map.pin[v] = corner;
  map.anchor[corner] = v;
}

void unpin(WorkingMap& map, VertexId v) {
  if (map.pin[v] < 0) return;
  map.anchor[map.pin[v]] = -1;
  map.pin[v] = -1;
}

int corner_of_pinned(const WorkingMap& map, VertexId v) {
  const auto w = barycentrics(map.at[v]);
  return static_cast<int>(std::max_element(w.begin(), w.end()) - w.begin());
}

void renew_pin(WorkingMap& map, VertexId v) {
  const DomainCorner c = map.corner_of[map.pin[v]];
  const UnitPoint step = corner_step(corner_of_pinned(map, v));
  for_each_outgoing(map.mesh, v, [&](Halfedge h) { map.chart[h] = chart_of_pinned(c.corner, map.chart[h](step)); });
  set_home(map, v, c.triangle, corner_position(c.corner));
}

namespace {

/// The chart of a vertex over one of its half-edges, as the straight line from the neighbour there tells it.
struct SeenFrom {
  Halfedge spoke = -1;
  UnitMotion chart;  ///< from the frame of `place.home` into that of the triangle of the spoke
  Walked place;
};

/// Seen from a neighbour that is free, the straight way to a vertex pinned to n ends in one of the triangles around n.
std::optional<SeenFrom> seen_from_a_neighbour(const WorkingMap& map, VertexId v, DomainVertex n) {
  const Halfedge start = map.mesh.outgoing[v];
  for (Halfedge spoke = start; spoke >= 0;) {
    const Halfedge next = map.mesh.next_around(spoke);
    for (const Halfedge neighbour : {next_in_triangle(spoke), previous_in_triangle(spoke)}) {
      // The other one is seen over the next spoke, where there is one.
      if (neighbour != next_in_triangle(spoke) && next >= 0) continue;
      const VertexId w = map.mesh.start(neighbour);
      if (map.pin[w] >= 0) continue;
      const Vec2d target = inverse(map.chart[neighbour])(map.chart[spoke](map.at[v]));
      const auto walked = walk(map.domain, map.home[w], map.at[w], target);
      if (!walked || corner_there(map.domain, walked->home, walked->at, n) < 0) continue;
      return SeenFrom{spoke, composed(map.chart[neighbour], walked->back), *walked};
    }
    spoke = next;
    if (spoke == start) break;
  }
  return std::nullopt;
}

}  // namespace

bool free_regular_vertex(WorkingMap& map, VertexId v) {
  const DomainVertex n = map.pin[v];
  if (map.kept[n]) return false;
  const auto seen = seen_from_a_neighbour(map, v, n);
  if (!seen) return false;
  std::vector<std::pair<Halfedge, UnitMotion>> charts{{seen->spoke, seen->chart}};
  const Halfedge end = last_of_fan(map.mesh, seen->spoke);
  for (Halfedge h = seen->spoke; h != end;) {
    const UnitMotion across = motion_across(map, previous_in_triangle(h));
    h = map.mesh.next_around(h);
    charts.emplace_back(h, composed(across, charts.back().second));
  }
  if (const Halfedge closing = previous_in_triangle(end); map.mesh.twins[closing] >= 0) {
    if (!(composed(motion_across(map, closing), charts.back().second) == seen->chart)) return false;
  }
  UnitMotion chart = seen->chart;
  for (Halfedge h = seen->spoke; map.mesh.on_boundary(v) && map.mesh.twins[h] >= 0;) {
    chart = composed(motion_across(map, h), chart);
    h = map.mesh.previous_around(h);
    charts.emplace_back(h, chart);
  }
  unpin(map, v);
  const int corner = corner_there(map.domain, seen->place.home, seen->place.at, n);
  set_home(map, v, seen->place.home, corner_position(corner));
  for (const auto& [h, motion] : charts) map.chart[h] = motion;
  if (map.mesh.on_boundary(v)) move_to_first_of_fan(map, v, {seen->place.home, corner});
  return true;
}

std::vector<DomainCorner> star_of(const WorkingMap& map, DomainVertex v) {
  const DomainCorner first = map.corner_of[v];
  std::vector<DomainCorner> star = corners_around(map.domain, first);
  if (next_around(map.domain, star.back()).triangle >= 0) return star;
  std::vector<DomainCorner> before;
  for (DomainCorner c = previous_around(map.domain, first); c.triangle >= 0; c = previous_around(map.domain, c)) {
    before.push_back(c);
  }
  star.insert(star.begin(), before.rbegin(), before.rend());
  return star;
}

Valence valence(const WorkingMap& map, DomainVertex v) {
  const DomainCorner first = map.corner_of[v];
  Valence found;
  DomainCorner c = first;
  do {
    ++found.triangles;
    c = next_around(map.domain, c);
  } while (!(c == first) && c.triangle >= 0);
  if (c == first) return found;
  found.on_boundary = true;
  for (c = previous_around(map.domain, first); c.triangle >= 0; c = previous_around(map.domain, c)) ++found.triangles;
  return found;
}

FlatImage flat_image(const WorkingMap& map, TriangleId t) {
  return {image_of_corner(map, t, 0), image_of_corner(map, t, 1), image_of_corner(map, t, 2)};
}

UnitMotion motion_across(const WorkingMap& map, Halfedge h) {
  const Halfedge g = map.mesh.twins[h];
  const Halfedge end = next_in_triangle(h);
  const Halfedge start_there = next_in_triangle(g);
  const VertexId v = map.mesh.start(h);
  const VertexId w = map.mesh.start(end);
  if (map.pin[v] < 0) return composed(map.chart[start_there], inverse(map.chart[h]));
  if (map.pin[w] < 0) return composed(map.chart[g], inverse(map.chart[end]));
  return motion_of_segment(map.chart[h](map.at[v]), map.chart[end](map.at[w]), map.chart[start_there](map.at[v]),
                           map.chart[g](map.at[w]));
}

void gather_ring(const WorkingMap& map, VertexId v, Ring& ring) {
  ring.at.clear();
  ring.halfedges.clear();
  const auto add = [&](Halfedge spoke, Halfedge neighbour) {
    const Vec2d& at = map.at[map.mesh.start(neighbour)];
    const UnitMotion& mine = map.chart[spoke];
    const UnitMotion& its = map.chart[neighbour];
    ring.at.push_back(mine == its ? at : composed(inverse(mine), its)(at));
  };
  const Halfedge first = map.mesh.outgoing[v];
  Halfedge h = first;
  for (;;) {
    add(h, next_in_triangle(h));
    ring.halfedges.push_back(h);
    const Halfedge next = map.mesh.next_around(h);
    if (next < 0) add(h, previous_in_triangle(h));
    if (next < 0 || next == first) return;
    h = next;
  }
}

void triangles_around(const WorkingMap& map, const std::vector<VertexId>& vertices, Marks& marks,
                      std::vector<TriangleId>& triangles) {
  triangles.clear();
  marks.clear(map.mesh.triangles.size());
  for (const VertexId v : vertices) {
    for_each_outgoing(map.mesh, v, [&](Halfedge h) {
      if (marks.add(h / 3)) triangles.push_back(h / 3);
    });
  }
}

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

double triangle_energy(const WorkingMap& map, TriangleId t) {
  const FlatImage p = flat_image(map, t);
  const RestShape& rest = map.rest[t];
  const double scale = map.scale();
  const double d = doubled_area(p) * rest.inverse_area * scale;
  if (!(d > 0)) return kInfinity;
  double length = 0;
  for (int i = 0; i < 3; ++i) length += rest.weight[i] * squared_distance(p[(i + 1) % 3], p[(i + 2) % 3]);
  return rest.share * evaluate(map.energy, length * scale, d);
}

double energy_of(const WorkingMap& map, const std::vector<TriangleId>& triangles) {
  double sum = 0;
  for (const TriangleId t : triangles) sum += triangle_energy(map, t);
  return sum;
}

double energy_around(const WorkingMap& map, const std::vector<VertexId>& vertices) {
  thread_local Marks marks;
  std::vector<TriangleId> triangles;
  triangles_around(map, vertices, marks, triangles);
  return energy_of(map, triangles);
}

double total_energy(const WorkingMap& map) {
  return sum_of_parts(map.mesh.triangles.size(), [&](std::size_t begin, std::size_t end) {
    double sum = 0;
    for (auto t = static_cast<TriangleId>(begin); t < static_cast<TriangleId>(end); ++t) {
      if (!map.mesh.removed(t)) sum += triangle_energy(map, t);
    }
    return sum;
  });
}

SideCrossed first_side_on(const Vec2d& from, const Vec2d& to) {
  // A point on a side must not be outside of both of its triangles.
  constexpr double kInside = -1e-13;
  const auto end = barycentrics(to);
  SideCrossed first{-1, kInfinity};
  if (end[0] >= kInside && end[1] >= kInside && end[2] >= kInside) return first;
  const auto start = barycentrics(from);
  for (int c = 0; c < 3; ++c) {
    if (end[c] >= kInside) continue;
    const double inside = std::max(start[c], 0.0);
    const double along = inside / (inside - end[c]);
    if (along < first.along) first = {(c + 1) % 3, along};
  }
  return first;
}

std::optional<Walked> walk(const Domain& domain, DomainTriangleId frame, Vec2d from, Vec2d to) {
  Walked result{frame, to, {}};
  constexpr int kMostTriangles = 64;
  for (int step = 0; step < kMostTriangles; ++step) {
    const SideCrossed crossed = first_side_on(from, result.at);
    if (crossed.side < 0) return result;
    const DomainSide n = domain.neighbour({result.home, crossed.side});
    if (!n.exists()) return std::nullopt;
    const UnitMotion& across = unit_transition(n.side, crossed.side);
    from = across(from + (result.at - from) * crossed.along);
    result = {n.triangle, across(result.at), composed(result.back, unit_transition(crossed.side, n.side))};
  }
  return std::nullopt;
}

namespace {

/// A vertex's place on the lattice. \param number  [domain triangle] its new one
DomainPoint point_of(const WorkingMap& map, VertexId v, const std::vector<DomainTriangleId>& number) {
  if (map.pin[v] >= 0) {
    const DomainCorner c = map.corner_of[map.pin[v]];
    return corner_point({number[c.triangle], c.corner});
  }
  if (map.mesh.on_boundary(v)) {
    const BoundaryPlace place = boundary_place(map, v);
    return point_on_side({number[place.side.triangle], place.side.side}, place.along);
  }
  const auto b = barycentrics(map.at[v]);
  return make_point(number[map.home[v]], b[0], b[1]);
}

}  // namespace

Parameterization finished(const WorkingMap& map) {
  Parameterization result;
  std::vector<DomainTriangleId> number(map.domain.triangles.size(), -1);
  std::vector<DomainVertex> vertex_number(map.corner_of.size(), -1);
  for (std::size_t t = 0; t < number.size(); ++t) {
    const DomainTriangle& d = map.domain.triangles[t];
    if (d.corners[0] < 0) continue;
    number[t] = result.domain.size();
    result.domain.triangles.push_back(d);
  }
  for (DomainTriangle& d : result.domain.triangles) {
    for (int s = 0; s < 3; ++s) {
      DomainVertex& v = vertex_number[d.corners[s]];
      if (v < 0) v = result.domain.vertex_count++;
      d.corners[s] = v;
      if (d.neighbours[s].exists()) d.neighbours[s].triangle = number[d.neighbours[s].triangle];
    }
  }
  result.phi.resize(map.home.size());
  for_each_part(result.phi.size(), [&](std::size_t begin, std::size_t end) {
    for (auto v = static_cast<VertexId>(begin); v < static_cast<VertexId>(end); ++v) {
      if (map.home[v] >= 0) result.phi[v] = point_of(map, v, number);
    }
  });
  return result;
}

}  // namespace lozenge
