// The two triangles at the side are a square of four corners around the new vertex: what lies in them is laid out there
// by its shares of the diagonals, four triangles take the place of two, and the layout is mapped back around one of the
// vertices nearest to the middle.
#include "stages/parameterize/operations/split.h"

#include <algorithm>
#include <array>
#include <vector>

#include "formats/domain/star_domain.h"
#include "stages/parameterize/map/pins.h"
#include "stages/parameterize/map/star.h"
#include "stages/parameterize/relax/anchor.h"
#include "stages/parameterize/relax/star_embedding.h"

namespace lozenge {

namespace {

/// Triangle (a, b, c) on the side's left, (b, a, d) on its right; in their place the triangles (n, b, c), (n, c, a),
/// (n, a, d) and (n, d, b), counter-clockwise around the new vertex n.
struct SplitPlan {
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

SplitPlan plan(const WorkingMap& map, DomainSide side) {
  SplitPlan s;
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
StarLayout lay_out(const WorkingMap& map, const SplitPlan& s) {
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
      layout.add(v, b * (2 * along - 1) + c * up);
    }
  }
  return layout;
}

void split_domain(WorkingMap& map, const SplitPlan& s) {
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

/// Keeps what `split_domain` changes.
void keep(LocalChange& change, const SplitPlan& s) {
  for (const DomainTriangleId t : s.triangles) change.keep_triangle(t);
  for (const DomainSide outer : s.outer) {
    if (outer.exists()) change.keep_triangle(outer.triangle);
  }
  for (const DomainVertex n : s.rim) change.keep_anchored(n);
  change.keep_domain_vertex(s.vertex);
}

}  // namespace

bool can_split(const WorkingMap& map, DomainSide side) {
  if (!map.domain.neighbour(side).exists()) return false;
  const SplitPlan s = plan(map, side);
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

std::optional<SplitResult> split(LocalChange& change, DomainSide side, const RelaxOptions& options) {
  constexpr std::size_t kMostTried = 3;  // nearest first; each costs an embedding
  WorkingMap& map = change.map();
  const SplitPlan s = plan(map, side);
  for (const DomainVertex opposite : {s.rim[1], s.rim[3]}) {
    if (!ensure_anchor_if_regular(map, opposite, change.scratch())) return std::nullopt;
  }
  const StarLayout layout = lay_out(map, s);
  if (layout.vertices.empty()) return std::nullopt;
  const Region region{{s.side.triangle, s.across.triangle}, layout.vertices, {s.rim.begin(), s.rim.end()}};
  if (!change.open(region)) return std::nullopt;
  keep(change, s);
  change.measure_before(map.domain_faces + 2);
  const auto embed = [&](std::size_t centre) {
    split_domain(map, s);
    for (const DomainVertex n : s.rim) {
      if (map.anchor[n] >= 0) renew_pin(map, map.anchor[n]);
    }
    return embed_star(change, s.vertex, layout, layout.at[centre], layout.vertices[centre], options);
  };
  if (!change.carry_out_first(nearest_in_layout(map, {4, false}, layout, {0, 0}, kMostTried), embed))
    return std::nullopt;
  return SplitResult{s.vertex, change.rise()};
}

std::optional<SplitResult> split(WorkingMap& map, DomainSide side, const RelaxOptions& options, Scratch& scratch) {
  return carry_out(map, scratch, [&](LocalChange& change) { return split(change, side, options); });
}

}  // namespace lozenge
