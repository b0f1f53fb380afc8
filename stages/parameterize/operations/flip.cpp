// The two triangles at the side are a rhombus. It is turned by a quarter and its diagonals change roles, which is
// affine and keeps all four sides where they are, so nothing outside has to know; then the stars around relax.
#include "stages/parameterize/operations/flip.h"

#include <algorithm>
#include <array>

#include "stages/parameterize/map/boundary.h"
#include "stages/parameterize/map/homes.h"
#include "stages/parameterize/map/pins.h"
#include "stages/parameterize/map/star.h"
#include "stages/parameterize/map/surroundings.h"
#include "stages/parameterize/relax/anchor.h"

namespace lozenge {

namespace {

/// The diamond: triangle (a, b, c) on the side's left, (b, a, d) on its right.
struct Diamond {
  DomainSide side, across;
  DomainVertex a, b, c, d;
};

Diamond diamond_of(const WorkingMap& map, DomainSide side) {
  const DomainSide across = map.domain.neighbour(side);
  return {side,
          across,
          map.domain.start(side),
          map.domain.end(side),
          map.domain.corner(side.triangle, (side.side + 2) % 3),
          map.domain.corner(across.triangle, (across.side + 2) % 3)};
}

bool are_joined(const WorkingMap& map, DomainVertex v, DomainVertex w) {
  for (const DomainCorner& c : star_of(map, v)) {
    if (map.domain.corner(c.triangle, (c.corner + 1) % 3) == w) return true;
    if (map.domain.corner(c.triangle, (c.corner + 2) % 3) == w) return true;
  }
  return false;
}

/// Source vertices at home in the triangles around the four corners, each once, unpinned.
std::vector<VertexId> vertices_of_stars(const WorkingMap& map, const Diamond& diamond) {
  std::vector<DomainTriangleId> triangles;
  for (const DomainVertex n : {diamond.a, diamond.b, diamond.c, diamond.d}) {
    for (const DomainCorner& c : star_of(map, n)) triangles.push_back(c.triangle);
  }
  std::sort(triangles.begin(), triangles.end());
  triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
  std::vector<VertexId> vertices;
  for (const DomainTriangleId t : triangles) {
    for (VertexId v = map.first_in[t]; v >= 0; v = map.next_in[v]) {
      if (map.pin[v] < 0) vertices.push_back(v);
    }
  }
  return vertices;
}

/// Position of a vertex at home in the diamond by the axes of the rhombus: x from a (0) to b (1), y from d (-1) to c
/// (1).
Vec2d on_axes(const WorkingMap& map, const Diamond& diamond, VertexId v) {
  const bool left = map.home[v] == diamond.side.triangle;
  const Vec2d p = to_corner_frame(left ? diamond.side.side : diamond.across.side)(map.at[v]);
  const Vec2d q(p.x, p.y / kHalfRoot3);
  return left ? q : Vec2d(1 - q.x, -q.y);
}

/// Rewires the two triangles: the side's own becomes (c, d, b), with the new edge from c to d as its side; the other
/// (d, c, a).
void flip_domain(WorkingMap& map, const Diamond& f) {
  Domain& domain = map.domain;
  const int s = f.side.side;
  const int t = f.across.side;
  const DomainSide bc = domain.neighbour({f.side.triangle, (s + 1) % 3});
  const DomainSide ca = domain.neighbour({f.side.triangle, (s + 2) % 3});
  const DomainSide ad = domain.neighbour({f.across.triangle, (t + 1) % 3});
  const DomainSide db = domain.neighbour({f.across.triangle, (t + 2) % 3});
  const auto join = [&](DomainSide p, DomainSide q) {
    domain.triangles[p.triangle].neighbours[p.side] = q;
    if (q.exists()) domain.triangles[q.triangle].neighbours[q.side] = p;
  };
  const auto set = [&](DomainSide first, DomainVertex p, DomainVertex q, DomainVertex r) {
    auto& corners = domain.triangles[first.triangle].corners;
    corners[first.side] = p;
    corners[(first.side + 1) % 3] = q;
    corners[(first.side + 2) % 3] = r;
    for (int i = 0; i < 3; ++i) map.corner_of[corners[i]] = {first.triangle, i};
  };
  set(f.side, f.c, f.d, f.b);
  set(f.across, f.d, f.c, f.a);
  join({f.side.triangle, (s + 1) % 3}, db);
  join({f.side.triangle, (s + 2) % 3}, bc);
  join({f.across.triangle, (t + 1) % 3}, ca);
  join({f.across.triangle, (t + 2) % 3}, ad);
}

/// From the frame of one of the diamond's triangles into that of one of them.
UnitMotion within_diamond(const Diamond& f, DomainTriangleId from, DomainTriangleId to) {
  if (from == to) return {};
  return to == f.side.triangle ? unit_transition(f.side.side, f.across.side)
                               : unit_transition(f.across.side, f.side.side);
}

/// The image of a corner of the flipped diamond, in the frame of the side's triangle.
UnitPoint corner_of_diamond(const WorkingMap& map, const Diamond& f, DomainVertex n) {
  for (int c = 0; c < 3; ++c) {
    if (map.domain.corner(f.side.triangle, c) == n) return corner_step(c);
  }
  return unit_transition(f.side.side, f.across.side)(corner_step((f.across.side + 2) % 3));
}

/// Gives the triangles around the diamond's vertices their charts.
void make_charts(WorkingMap& map, const Diamond& f, const std::vector<MovingTriangle>& surroundings) {
  const auto in_diamond = [&](VertexId v) {
    return map.pin[v] < 0 && (map.home[v] == f.side.triangle || map.home[v] == f.across.triangle);
  };
  for (const MovingTriangle& m : surroundings) {
    for (int c = 0; c < 3; ++c) {
      const VertexId v = map.mesh.triangles[m.triangle][c];
      UnitMotion& chart = map.chart[3 * m.triangle + c];
      if (!m.is_inside()) {
        if (!in_diamond(v)) continue;
        const DomainTriangleId inner = map.domain.neighbour(m.gate.outer).triangle;
        chart = composed(chart_inside(map, m.gate), within_diamond(f, map.home[v], inner));
      } else if (map.pin[v] >= 0) {
        chart = chart_of_pinned(corner_of_pinned(map, v), corner_of_diamond(map, f, map.pin[v]));
      } else {
        chart = within_diamond(f, map.home[v], f.side.triangle);
      }
    }
  }
}

/// The side that one of the diamond's four becomes when it is flipped.
DomainSide flipped(const Diamond& f, DomainSide outer) {
  const bool is_next = outer.side == ((outer.triangle == f.side.triangle ? f.side.side : f.across.side) + 1) % 3;
  if (outer.triangle == f.side.triangle)
    return is_next ? DomainSide{f.side.triangle, (f.side.side + 2) % 3}
                   : DomainSide{f.across.triangle, (f.across.side + 1) % 3};
  return is_next ? DomainSide{f.across.triangle, (f.across.side + 2) % 3}
                 : DomainSide{f.side.triangle, (f.side.side + 1) % 3};
}

/// Carries the vertices of the diamond over: the rhombus is turned by a quarter and its diagonals change roles, an
/// affine map that keeps its four sides pointwise.
void carry_over(WorkingMap& map, const Diamond& f, const std::vector<MovingTriangle>& surroundings) {
  std::vector<std::pair<VertexId, Vec2d>> moved;
  std::vector<std::pair<VertexId, BoundaryPlace>> slid;
  std::vector<VertexId> pinned;
  for (const DomainTriangleId t : {f.side.triangle, f.across.triangle}) {
    for (VertexId v = map.first_in[t]; v >= 0; v = map.next_in[v]) {
      if (map.pin[v] >= 0) pinned.push_back(v);
      else if (map.mesh.on_boundary(v)) slid.emplace_back(v, boundary_place(map, v));
      else moved.emplace_back(v, on_axes(map, f, v));
    }
  }
  flip_domain(map, f);
  for (const auto& [v, axes] : moved) {
    // Along the new edge from c to d, and across it towards b, in shares of the diagonals.
    const double along = (1 - axes.y) / 2;
    const double across = 2 * axes.x - 1;
    const bool in_side = across >= 0;
    const Vec2d p = in_side ? Vec2d(along, across * kHalfRoot3) : Vec2d(1 - along, -across * kHalfRoot3);
    const DomainSide home = in_side ? f.side : f.across;
    set_home(map, v, home.triangle, from_corner_frame(home.side)(p));
  }
  for (auto& [v, place] : slid) {
    place.side = flipped(f, place.side);
    set_home(map, v, place.side.triangle, position_of(place));
  }
  for (const VertexId v : pinned) renew_pin(map, v);
  make_charts(map, f, surroundings);
}

Region region_of(const WorkingMap& map, const Diamond& f) {
  Region region{{f.side.triangle, f.across.triangle}, {}, {f.a, f.b, f.c, f.d}};
  for (const DomainTriangleId t : region.triangles) {
    for (VertexId v = map.first_in[t]; v >= 0; v = map.next_in[v]) {
      if (map.pin[v] < 0) region.moving.push_back(v);
    }
  }
  return region;
}

bool anchor_corners(WorkingMap& map, const Diamond& f, Scratch& scratch) {
  const std::array corners{f.a, f.b, f.c, f.d};
  return std::all_of(corners.begin(), corners.end(),
                     [&](DomainVertex n) { return ensure_anchor_if_regular(map, n, scratch); });
}

/// Flips and relaxes. \return by how much the energy of the four stars rose; nothing where the map would be folded
std::optional<double> flip(LocalChange& change, DomainSide side, const RelaxOptions& options) {
  WorkingMap& map = change.map();
  const Diamond f = diamond_of(map, side);
  if (!anchor_corners(map, f, change.scratch())) return std::nullopt;
  const std::vector<VertexId> around = vertices_of_stars(map, f);
  if (!change.open(region_of(map, f))) return std::nullopt;
  for (const DomainTriangleId t : {f.side.triangle, f.across.triangle}) change.keep_triangle_and_neighbours(t);
  for (const DomainVertex n : {f.a, f.b, f.c, f.d}) change.keep_anchored(n);
  change.keep_around(around);
  change.measure_before();
  carry_over(map, f, change.surroundings());
  if (!heal_folds(map, around) || !are_consistent(map, change.surroundings())) return std::nullopt;
  relax(map, around, options);
  return change.rise();
}

}  // namespace

bool can_flip(const WorkingMap& map, DomainSide side) {
  if (!map.domain.neighbour(side).exists()) return false;
  const Diamond f = diamond_of(map, side);
  const auto may_lose = [&](DomainVertex n) {
    const Valence v = valence(map, n);
    return v.triangles > v.least();
  };
  const auto may_gain = [&](DomainVertex n) {
    const Valence v = valence(map, n);
    return v.triangles < v.most();
  };
  return f.c != f.d && may_lose(f.a) && may_lose(f.b) && may_gain(f.c) && may_gain(f.d) && !are_joined(map, f.c, f.d);
}

double flip_gain(const WorkingMap& map, const SurfaceMeasures& measures, DomainSide side) {
  return path_length(map, measures, side) - flipped_path_length(map, measures, side);
}

std::optional<double> flip(WorkingMap& map, DomainSide side, const RelaxOptions& options, Scratch& scratch) {
  return carry_out(map, scratch, [&](LocalChange& change) { return flip(change, side, options); });
}

std::optional<double> flip_if_better(WorkingMap& map, DomainSide side, const RelaxOptions& options, Scratch& scratch) {
  return carry_out(map, scratch, [&](LocalChange& change) {
    const auto rise = flip(change, side, options);
    return rise && *rise < 0 ? rise : std::nullopt;
  });
}

int evenness_gain(const WorkingMap& map, DomainSide side) {
  const Diamond f = diamond_of(map, side);
  const auto lack = [&](DomainVertex n) { return valence(map, n).lack(); };
  return lack(f.c) + lack(f.d) - lack(f.a) - lack(f.b) - 2;
}

}  // namespace lozenge
