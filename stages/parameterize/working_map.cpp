#include "stages/parameterize/working_map.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lozenge {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

bool are_adjacent(const Domain& domain, DomainTriangleId t, DomainTriangleId u) {
  const auto& n = domain.triangles[t].neighbours;
  return n[0].triangle == u || n[1].triangle == u || n[2].triangle == u;
}

double squared_distance(const Vec2d& a, const Vec2d& b) { return (a - b).length2(); }

/// `p` lies `slots` triangles counter-clockwise of the frame's corner, in a star of `valence` triangles. Unfolds it by
/// the shorter way from `from`; both points are relative to the star's vertex.
std::optional<Vec2d> unfold(const Vec2d& p, int slots, int star_valence, const Vec2d& from) {
  if (star_valence == 6) return turned(p, slots);
  constexpr double kSixth = 3.14159265358979323846 / 3;
  const double ccw = slots * kSixth + std::atan2(p.y, p.x) - std::atan2(from.y, from.x);
  const double cw = star_valence * kSixth - ccw;
  if (std::min(ccw, cw) >= 3 * kSixth) return std::nullopt;
  return turned(p, ccw <= cw ? slots : slots - star_valence);
}

std::optional<Vec2d> place_in_star(const WorkingMap& map, DomainTriangleId home, const Vec2d& p, DomainTriangleId frame,
                                   const Vec2d& from) {
  for (int a = 0; a < 3; ++a) {
    const DomainVertex centre = map.domain.corner(frame, a);
    for (int b = 0; b < 3; ++b) {
      if (map.domain.corner(home, b) != centre) continue;
      int slots = 0;
      int star_valence = 0;
      DomainCorner c{frame, a};
      do {
        if (c.triangle == home) slots = star_valence;
        ++star_valence;
        c = next_around(map.domain, c);
      } while (c.triangle != frame);
      const auto unfolded = unfold(to_corner_frame(b, p), slots, star_valence, to_corner_frame(a, from));
      if (!unfolded) return std::nullopt;
      return from_corner_frame(a, *unfolded);
    }
  }
  return std::nullopt;
}

/// The domain vertex itself, seen from the frame: a corner, else across a side, else in a star around one of the
/// corners; the nearest to `from` of each kind.
std::optional<Vec2d> place_domain_vertex(const WorkingMap& map, DomainVertex v, DomainTriangleId frame,
                                         const Vec2d& from) {
  for (int c = 0; c < 3; ++c) {
    if (map.domain.corner(frame, c) == v) return corner_position(c);
  }
  std::optional<Vec2d> nearest;
  const auto consider = [&](const std::optional<Vec2d>& p) {
    if (p && (!nearest || squared_distance(*p, from) < squared_distance(*nearest, from))) nearest = p;
  };
  for (int s = 0; s < 3; ++s) {
    const DomainSide n = map.domain.neighbour({frame, s});
    const int far = (n.side + 2) % 3;
    if (n.exists() && map.domain.corner(n.triangle, far) == v) {
      consider(plane_transition(s, n.side)(corner_position(far)));
    }
  }
  if (nearest) return nearest;
  for (int a = 0; a < 3; ++a) {
    const DomainCorner first{frame, a};
    for (DomainCorner c = next_around(map.domain, first); c.triangle != frame; c = next_around(map.domain, c)) {
      for (int corner = 1; corner < 3; ++corner) {
        const int i = (c.corner + corner) % 3;
        if (map.domain.corner(c.triangle, i) != v) continue;
        consider(place_in_star(map, c.triangle, corner_position(i), frame, from));
      }
    }
  }
  return nearest;
}

/// Around a vertex of three triangles, the one beyond `side` is also reached over the third: `p` of it, seen that way.
std::optional<Vec2d> place_around_three(const WorkingMap& map, DomainSide side, const Vec2d& p) {
  const DomainTriangleId home = map.domain.neighbour(side).triangle;
  for (int other = 1; other < 3; ++other) {
    const int s = (side.side + other) % 3;
    const DomainSide third = map.domain.neighbour({side.triangle, s});
    if (!third.exists()) continue;
    for (int beyond = 0; beyond < 3; ++beyond) {
      const DomainSide n = map.domain.neighbour({third.triangle, beyond});
      if (n.triangle != home) continue;
      return plane_transition(s, third.side)(plane_transition(beyond, n.side)(p));
    }
  }
  return std::nullopt;
}

/// Where one face, diamond or star holds both.
std::optional<Vec2d> place_near(const WorkingMap& map, VertexId w, DomainTriangleId frame, const Vec2d& from) {
  if (map.pin[w] >= 0) return place_domain_vertex(map, map.pin[w], frame, from);
  const DomainTriangleId home = map.home[w];
  if (home == frame) return map.at[w];
  for (int s = 0; s < 3; ++s) {
    const DomainSide n = map.domain.neighbour({frame, s});
    if (n.triangle != home) continue;
    const Vec2d across = plane_transition(s, n.side)(map.at[w]);
    const auto around = place_around_three(map, {frame, s}, map.at[w]);
    return around && squared_distance(*around, from) < squared_distance(across, from) ? *around : across;
  }
  return place_in_star(map, home, map.at[w], frame, from);
}

/// The image of a triangle with all corners pinned: its three domain vertices, in the frame of a triangle around the
/// first.
std::optional<FlatImage> image_of_pinned(const WorkingMap& map, const std::array<VertexId, 3>& t) {
  std::optional<FlatImage> best;
  double best_length = kInfinity;
  const DomainCorner first = map.corner_of[map.pin[t[0]]];
  DomainCorner c = first;
  do {
    const Vec2d origin = corner_position(c.corner);
    const auto p = place_domain_vertex(map, map.pin[t[1]], c.triangle, origin);
    const auto q = place_domain_vertex(map, map.pin[t[2]], c.triangle, origin);
    if (p && q) {
      const FlatImage image{c.triangle, {origin, *p, *q}};
      const double length = squared_distance(origin, *p) + squared_distance(*p, *q) + squared_distance(*q, origin);
      // 1e-9: the long way around the corner gives a folded image, whatever its length.
      if (image.doubled_area() > 1e-9 && length < best_length) {
        best = image;
        best_length = length;
      }
    }
    c = next_around(map.domain, c);
  } while (!(c == first));
  return best;
}

/// All three corners, seen from the unpinned corner i.
std::optional<FlatImage> image_from(const WorkingMap& map, const std::array<VertexId, 3>& corners, int i) {
  FlatImage image{map.home[corners[i]], {}};
  image.at[i] = map.at[corners[i]];
  for (int j = 0; j < 3; ++j) {
    if (j == i) continue;
    const auto p = place(map, corners[j], image.frame, image.at[i]);
    if (!p) return std::nullopt;
    image.at[j] = *p;
  }
  return image;
}

}  // namespace

RestShape rest_shape(const std::vector<Vec3f>& positions, const std::array<VertexId, 3>& t, double surface_area) {
  const Vec3d p(positions[t[0]]), q(positions[t[1]]), r(positions[t[2]]);
  const std::array<Vec3d, 3> side{r - q, p - r, q - p};  // opposite corner 0, 1, 2
  const double longest = std::max({side[0].length2(), side[1].length2(), side[2].length2()});
  double doubled = side[2].cross(r - p).length();
  RestShape shape;
  // A triangle flatter than this has no shape to keep, only an orientation; it gets a height that the arithmetic can
  // hold.
  constexpr double kThinnest = 1e-6;
  const double floor = std::max(longest * kThinnest, surface_area * 1e-14);
  shape.share = static_cast<float>(std::max(doubled, floor) / 2 / surface_area);
  doubled = std::max(doubled, floor);
  for (int i = 0; i < 3; ++i) {
    const double cotangent = -side[(i + 1) % 3].dot(side[(i + 2) % 3]) / doubled;
    shape.weight[i] = static_cast<float>(cotangent / doubled);
  }
  shape.inverse_area = static_cast<float>(1 / doubled);
  return shape;
}

void measure_rest_shapes(WorkingMap& map) {
  map.surface_area = 0;
  for (const auto& t : map.mesh.triangles) {
    if (t[0] < 0) continue;
    const Vec3d p((*map.positions)[t[0]]);
    map.surface_area += (Vec3d((*map.positions)[t[1]]) - p).cross(Vec3d((*map.positions)[t[2]]) - p).length() / 2;
  }
  map.rest.resize(map.mesh.triangles.size());
  for (std::size_t t = 0; t < map.rest.size(); ++t) {
    if (map.mesh.triangles[t][0] >= 0)
      map.rest[t] = rest_shape(*map.positions, map.mesh.triangles[t], map.surface_area);
  }
}

WorkingMap trivial_map(const std::vector<Vec3f>& positions, HalfedgeMesh mesh) {
  WorkingMap map;
  map.positions = &positions;
  map.mesh = std::move(mesh);
  measure_rest_shapes(map);
  const std::size_t vertices = map.mesh.outgoing.size();
  map.home.assign(vertices, -1);
  map.at.assign(vertices, Vec2d(0, 0));
  map.pin.assign(vertices, -1);
  map.next_in.assign(vertices, -1);
  map.last_in.assign(vertices, -1);

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
  map.first_in.assign(map.domain.triangles.size(), -1);
  map.home.assign(vertices, -1);
  map.at.assign(vertices, Vec2d(0, 0));
  map.pin.assign(vertices, -1);
  map.next_in.assign(vertices, -1);
  map.last_in.assign(vertices, -1);
  for (VertexId v = 0; v < static_cast<VertexId>(vertices); ++v) {
    const DomainPoint& p = finished_map.phi[v];
    if (const DomainVertex corner = vertex_at(map.domain, p); corner >= 0) pin_to(map, v, corner);
    else set_home(map, v, p.triangle, at_barycentrics(p.beta, p.gamma()));
  }
  return map;
}

void set_home(WorkingMap& map, VertexId v, DomainTriangleId home, const Vec2d& at) {
  map.at[v] = at;
  if (map.home[v] == home) return;
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

int valence(const WorkingMap& map, DomainVertex v) {
  const DomainCorner first = map.corner_of[v];
  int count = 0;
  DomainCorner c = first;
  do {
    ++count;
    c = next_around(map.domain, c);
  } while (!(c == first));
  return count;
}

std::optional<Vec2d> place(const WorkingMap& map, VertexId w, DomainTriangleId frame, const Vec2d& from) {
  if (const auto near = place_near(map, w, frame, from)) return near;
  // A long edge of a coarse level: seen from one of the triangles beside the frame.
  std::optional<Vec2d> nearest;
  for (int s = 0; s < 3; ++s) {
    const DomainSide n = map.domain.neighbour({frame, s});
    if (!n.exists()) continue;
    const auto there = place_near(map, w, n.triangle, plane_transition(n.side, s)(from));
    if (!there) continue;
    const Vec2d here = plane_transition(s, n.side)(*there);
    if (!nearest || squared_distance(here, from) < squared_distance(*nearest, from)) nearest = here;
  }
  return nearest;
}

bool gather_ring(const WorkingMap& map, VertexId v, DomainTriangleId frame, const Vec2d& at, Ring& ring) {
  ring.vertices.clear();
  ring.at.clear();
  ring.halfedges.clear();
  ring.reaches_far = false;
  const Halfedge first = map.mesh.outgoing[v];
  Halfedge h = first;
  do {
    const VertexId w = map.mesh.end(h);
    if (map.home[w] == frame && map.pin[w] < 0) {
      ring.at.push_back(map.at[w]);
    } else {
      const auto p = place(map, w, frame, at);
      if (!p) return false;
      ring.at.push_back(*p);
      ring.reaches_far = ring.reaches_far || map.pin[w] >= 0 || !are_adjacent(map.domain, frame, map.home[w]);
    }
    ring.vertices.push_back(w);
    ring.halfedges.push_back(h);
    h = map.mesh.next_around(h);
  } while (h != first);
  return true;
}

std::optional<FlatImage> flat_image(const WorkingMap& map, TriangleId t) {
  const std::array<VertexId, 3>& corners = map.mesh.triangles[t];
  // Around a vertex of few triangles the other corners may be seen the wrong way from one corner, and rightly from
  // another.
  std::optional<FlatImage> image;
  bool all_pinned = true;
  for (int i = 0; i < 3; ++i) {
    if (map.pin[corners[i]] >= 0) continue;
    all_pinned = false;
    if (const auto seen = image_from(map, corners, i)) image = seen;
    if (image && image->doubled_area() > 0) return image;
  }
  return all_pinned ? image_of_pinned(map, corners) : image;
}

double doubled_image_area(const WorkingMap& map, TriangleId t) {
  const auto image = flat_image(map, t);
  return image ? image->doubled_area() : -1;
}

bool is_sound(const WorkingMap& map, VertexId v) {
  constexpr double kSame = 1e-9;
  const auto side = [](const FlatImage& image, int s) { return squared_distance(image.at[s], image.at[(s + 1) % 3]); };
  const Halfedge first = map.mesh.outgoing[v];
  Halfedge h = first;
  do {
    const auto image = flat_image(map, h / 3);
    if (!image || !(image->doubled_area() > 0)) return false;
    for (const Halfedge e : {h, next_in_triangle(h)}) {
      const auto beyond = flat_image(map, map.mesh.twins[e] / 3);
      if (!beyond || std::abs(side(*image, e % 3) - side(*beyond, map.mesh.twins[e] % 3)) > kSame) return false;
    }
    h = map.mesh.next_around(h);
  } while (h != first);
  return true;
}

double triangle_energy(const WorkingMap& map, TriangleId t) {
  const auto image = flat_image(map, t);
  if (!image) return kInfinity;
  const RestShape& rest = map.rest[t];
  const double scale = map.scale();
  const double d = image->doubled_area() * rest.inverse_area * scale;
  if (!(d > 0)) return kInfinity;
  double length = 0;
  for (int i = 0; i < 3; ++i)
    length += rest.weight[i] * squared_distance(image->at[(i + 1) % 3], image->at[(i + 2) % 3]);
  return rest.share * evaluate(map.energy, length * scale, d);
}

double total_energy(const WorkingMap& map) {
  double sum = 0;
  for (TriangleId t = 0; t < map.mesh.triangle_count(); ++t) {
    if (!map.mesh.removed(t)) sum += triangle_energy(map, t);
  }
  return sum;
}

std::optional<Walked> walk(const Domain& domain, DomainTriangleId frame, Vec2d from, Vec2d to) {
  constexpr int kMostTriangles = 32;
  for (int step = 0; step < kMostTriangles; ++step) {
    const auto end = barycentrics(to);
    if (end[0] >= 0 && end[1] >= 0 && end[2] >= 0) return Walked{frame, to};
    const auto start = barycentrics(from);
    int leave = -1;
    double first = kInfinity;
    for (int c = 0; c < 3; ++c) {
      if (end[c] >= 0) continue;
      const double t = std::max(start[c], 0.0) / (std::max(start[c], 0.0) - end[c]);
      if (t < first) {
        first = t;
        leave = (c + 1) % 3;
      }
    }
    const DomainSide n = domain.neighbour({frame, leave});
    if (!n.exists()) return std::nullopt;
    const PlaneMotion& back = plane_transition(n.side, leave);
    from = back(from + (to - from) * first);
    to = back(to);
    frame = n.triangle;
  }
  return std::nullopt;
}

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
  for (std::size_t v = 0; v < result.phi.size(); ++v) {
    if (map.home[v] < 0) continue;
    if (map.pin[v] >= 0) {
      const DomainCorner c = map.corner_of[map.pin[v]];
      result.phi[v] = corner_point({number[c.triangle], c.corner});
      continue;
    }
    const auto b = barycentrics(map.at[v]);
    result.phi[v] = make_point(number[map.home[v]], b[0], b[1]);
  }
  return result;
}

}  // namespace lozenge
