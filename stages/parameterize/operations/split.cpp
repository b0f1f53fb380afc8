#include "stages/parameterize/operations/split.h"

#include <algorithm>
#include <array>
#include <vector>

#include "formats/domain/star_domain.h"
#include "stages/parameterize/relax/star_embedding.h"

namespace lozenge {

namespace {

/// Triangle (a, b, c) on the side's left, (b, a, d) on its right; in their place the triangles (n, b, c), (n, c, a),
/// (n, a, d) and (n, d, b), counter-clockwise around the new vertex n.
struct Split {
  DomainSide side, across;
  std::array<DomainVertex, 4> rim;  ///< b, c, a, d
  std::array<DomainSide, 4> outer;  ///< beyond bc, ca, ad, db
  std::array<DomainTriangleId, 4> triangles;
  DomainVertex vertex = -1;
};

DomainTriangleId removed_triangle(const WorkingMap& map, DomainTriangleId from) {
  while (from < map.domain.size() && map.domain.corner(from, 0) >= 0) ++from;
  return from < map.domain.size() ? from : -1;
}

DomainVertex removed_vertex(const WorkingMap& map) {
  for (std::size_t v = 0; v < map.corner_of.size(); ++v) {
    if (map.corner_of[v].triangle < 0) return static_cast<DomainVertex>(v);
  }
  return -1;
}

Split plan(const WorkingMap& map, DomainSide side) {
  Split s;
  s.side = side;
  s.across = map.domain.neighbour(side);
  const auto corner = [&](DomainSide h, int i) { return map.domain.corner(h.triangle, (h.side + i) % 3); };
  const auto beyond = [&](DomainSide h, int i) { return map.domain.neighbour({h.triangle, (h.side + i) % 3}); };
  s.rim = {corner(s.side, 1), corner(s.side, 2), corner(s.side, 0), corner(s.across, 2)};
  s.outer = {beyond(s.side, 1), beyond(s.side, 2), beyond(s.across, 1), beyond(s.across, 2)};
  const DomainTriangleId first = removed_triangle(map, 0);
  const DomainTriangleId second = first < 0 ? -1 : removed_triangle(map, first + 1);
  s.triangles = {side.triangle, first, s.across.triangle, second};
  s.vertex = removed_vertex(map);
  return s;
}

/// The vertices at home in the two triangles, in the square that is the polygon of the new star.
StarLayout lay_out(const WorkingMap& map, const Split& s) {
  StarLayout layout;
  const Vec2d b = star_corner(4, 0), c = star_corner(4, 1);
  for (const DomainSide half : {s.side, s.across}) {
    const bool left = half == s.side;
    for (VertexId v = map.first_in[half.triangle]; v >= 0; v = map.next_in[v]) {
      if (map.pin[v] >= 0) continue;
      // Shares of the diagonals: along from a (0) to b (1), up from the side (0) to c or d (1).
      const Vec2d p = to_corner_frame(half.side)(map.at[v]);
      const double along = left ? p.x : 1 - p.x;
      const double up = p.y / kHalfRoot3 * (left ? 1 : -1);
      layout.vertices.push_back(v);
      layout.at.push_back(b * (2 * along - 1) + c * up);
    }
  }
  return layout;
}

void split_domain(WorkingMap& map, const Split& s) {
  for (int i = 0; i < 4; ++i) {
    DomainTriangle& t = map.domain.triangles[s.triangles[i]];
    t.corners = {s.vertex, s.rim[i], s.rim[(i + 1) % 4]};
    t.neighbours = {DomainSide{s.triangles[(i + 3) % 4], 2}, s.outer[i], DomainSide{s.triangles[(i + 1) % 4], 0}};
    if (s.outer[i].exists())
      map.domain.triangles[s.outer[i].triangle].neighbours[s.outer[i].side] = {s.triangles[i], 1};
    map.corner_of[s.rim[i]] = {s.triangles[i], 1};
  }
  map.corner_of[s.vertex] = {s.triangles[0], 0};
  map.anchor[s.vertex] = -1;
  map.kept[s.vertex] = 0;
  map.domain_faces += 2;
}

void keep(const WorkingMap& map, const Split& s, Checkpoint& undo) {
  for (const DomainTriangleId t : s.triangles) undo.keep_triangle(t);
  for (const DomainSide outer : s.outer) {
    if (outer.exists()) undo.keep_triangle(outer.triangle);
  }
  for (const DomainVertex n : s.rim) {
    undo.keep_domain_vertex(n);
    if (map.anchor[n] < 0) continue;
    undo.keep_vertex(map.anchor[n]);
    for_each_outgoing(map.mesh, map.anchor[n], [&](Halfedge h) { undo.keep_charts(h / 3); });
  }
}

}  // namespace

bool can_split(const WorkingMap& map, DomainSide side) {
  if (!map.domain.neighbour(side).exists()) return false;
  const Split s = plan(map, side);
  if (s.vertex < 0 || s.triangles[3] < 0) return false;
  const bool folds_on_itself = std::any_of(s.outer.begin(), s.outer.end(), [&](DomainSide outer) {
    return outer.triangle == s.side.triangle || outer.triangle == s.across.triangle;
  });
  const auto has_room = [&](DomainVertex n) {
    const Valence v = valence(map, n);
    return v.triangles < v.most();
  };
  return !folds_on_itself && s.rim[1] != s.rim[3] && has_room(s.rim[1]) && has_room(s.rim[3]);
}

DomainVertex split(WorkingMap& map, DomainSide side, const RelaxOptions& options, Checkpoint& undo, double& rise) {
  const Split s = plan(map, side);
  for (const DomainVertex opposite : {s.rim[1], s.rim[3]}) {
    if (valence(map, opposite).is_regular() && !ensure_anchor(map, opposite)) return -1;
  }
  const StarLayout layout = lay_out(map, s);
  if (layout.vertices.empty()) return -1;
  std::vector<Hanging> hanging;
  const Region region{{s.side.triangle, s.across.triangle}, layout.vertices, {s.rim.begin(), s.rim.end()}};
  if (!find_surroundings(map, region, hanging)) return -1;
  map.domain_faces += 2;
  const double before = energy_of(map, hanging);
  map.domain_faces -= 2;
  keep(map, s, undo);
  keep_layout(undo, s.vertex, layout, hanging);
  for (const std::size_t centre : nearest_in_layout(map, {4, false}, layout, {0, 0}, 3)) {
    split_domain(map, s);
    for (const DomainVertex n : s.rim) {
      if (map.anchor[n] >= 0) renew_pin(map, map.anchor[n]);
    }
    if (embed_star(map, s.vertex, layout, hanging, layout.at[centre], layout.vertices[centre], options)) {
      rise = energy_of(map, hanging) - before;
      return s.vertex;
    }
    undo.restore();
  }
  return -1;
}

}  // namespace lozenge
