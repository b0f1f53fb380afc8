#include "stages/parameterize/operations/collapse.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "stages/parameterize/map/map_energy.h"
#include "stages/parameterize/map/marks.h"
#include "stages/parameterize/map/pins.h"
#include "stages/parameterize/map/star.h"
#include "stages/parameterize/operations/warm_up.h"
#include "stages/parameterize/relax/star_embedding.h"
#include "stages/parameterize/relax/wedge.h"

namespace lozenge {

namespace {

/// One triangle of the star that is made: the corner that will be the star's, and which end it belongs to now.
struct Slice {
  DomainCorner corner;
  bool of_a = false;
};

/// The two fans that become one star. Slices are numbered counter-clockwise around it. Corner m of the rim starts slice
/// m; inside of the surface the first one lies opposite the side in its own triangle, and slice by slice a's fan comes
/// first, then b's. On the boundary the star starts where the boundary leaves it.
struct Fans {
  DomainVertex a, b;
  DomainVertex kept, gone;  ///< of the two
  DomainSide side, across;  ///< the triangles that vanish; `across` doesn't exist on the boundary
  std::vector<Slice> slices;
  bool on_boundary = false;
  bool a_on_boundary = false, b_on_boundary = false;
  /// The corners of the rim that an end shares with the other one, counter-clockwise behind its own slices and before
  /// them; -1 beyond the boundary. Those before a and behind b are the one opposite the side in its own triangle.
  struct Shared {
    int before = -1;
    int behind = -1;
  };
  Shared shared_of_a, shared_of_b;

  int count() const { return static_cast<int>(slices.size()); }
  StarPolygon polygon() const { return {count(), on_boundary}; }
  void add(const std::vector<DomainCorner>& corners, std::size_t begin, std::size_t end, bool of_a) {
    for (std::size_t i = begin; i < end; ++i) slices.push_back({corners[i], of_a});
  }
};

/// Of a side inside whose ends are a vertex inside and one on the boundary: around the latter up to the side, around
/// the other, and on.
void join_inside_to_boundary(const WorkingMap& map, Fans& fans) {
  const bool of_a = fans.a_on_boundary;  // the end on the boundary
  const std::vector<DomainCorner> outer = star_of(map, of_a ? fans.a : fans.b);
  const DomainSide from =
      of_a ? fans.side : fans.across;  // leaves the end on the boundary; the later of both triangles
  const DomainSide other = of_a ? fans.across : fans.side;
  const std::vector<DomainCorner> inner = corners_around(map.domain, {other.triangle, other.side});
  std::size_t later = 0;
  while (!(outer[later] == DomainCorner{from.triangle, from.side})) ++later;
  fans.add(outer, 0, later - 1, of_a);
  const int first = fans.count();
  fans.add(inner, 1, inner.size() - 1, !of_a);
  const int last = fans.count();
  fans.add(outer, later + 1, outer.size(), of_a);
  // Between the end inside and the slices of the one on the boundary there is one on either side.
  (of_a ? fans.shared_of_a : fans.shared_of_b) = {last, first};
  (of_a ? fans.shared_of_b : fans.shared_of_a) = {first, last};
}

DomainVertex surviving_end(const WorkingMap& map, DomainVertex a, DomainVertex b) { return map.kept[b] ? b : a; }

Fans find_fans(const WorkingMap& map, DomainSide side) {
  Fans fans;
  fans.a = map.domain.start(side);
  fans.b = map.domain.end(side);
  fans.kept = surviving_end(map, fans.a, fans.b);
  fans.gone = fans.kept == fans.a ? fans.b : fans.a;
  fans.side = side;
  fans.across = map.domain.neighbour(side);
  fans.a_on_boundary = valence(map, fans.a).on_boundary;
  fans.b_on_boundary = valence(map, fans.b).on_boundary;
  fans.on_boundary = fans.a_on_boundary || fans.b_on_boundary;
  if (!fans.across.exists()) {
    const std::vector<DomainCorner> around_a = star_of(map, fans.a);
    const std::vector<DomainCorner> around_b = star_of(map, fans.b);
    fans.add(around_b, 0, around_b.size() - 1, false);
    fans.shared_of_b.behind = fans.shared_of_a.before = fans.count();
    fans.add(around_a, 1, around_a.size(), true);
  } else if (fans.on_boundary) {
    join_inside_to_boundary(map, fans);
  } else {
    const std::vector<DomainCorner> around_a = corners_around(map.domain, {side.triangle, side.side});
    const std::vector<DomainCorner> around_b = corners_around(map.domain, {fans.across.triangle, fans.across.side});
    fans.add(around_a, 1, around_a.size() - 1, true);
    const int between = fans.count();
    fans.add(around_b, 1, around_b.size() - 1, false);
    fans.shared_of_a = {0, between};
    fans.shared_of_b = {between, fans.count()};
  }
  return fans;
}

/// Weights of an equilateral triangle of unit sides, as a rest shape.
RestShape equilateral() {
  RestShape rest;
  rest.weight.fill(2.0F / 3.0F);
  rest.inverse_area = static_cast<float>(1 / kHalfRoot3);
  rest.share = 1;
  return rest;
}

/// Where the ends of the collapsed side lie in the new star's polygon.
struct Ends {
  Vec2d a, b;
};

/// The mean of the rim's corners around one end.
Vec2d mean_of_rim(const Fans& fans, bool of_a) {
  const StarPolygon polygon = fans.polygon();
  Vec2d sum(0, 0);
  int count = 0;
  for (int m = 0; m < fans.count(); ++m) {
    if (fans.slices[m].of_a != of_a) continue;
    const bool continues = m > 0 && fans.slices[m - 1].of_a == of_a;
    for (int i = continues ? m + 1 : m; i <= m + 1; ++i, ++count) sum += polygon.corner(i);
  }
  return count > 0 ? sum / count : Vec2d(0, 0);
}

int count_slices(const Fans& fans, bool of_a) {
  return static_cast<int>(
      std::count_if(fans.slices.begin(), fans.slices.end(), [&](const Slice& s) { return s.of_a == of_a; }));
}

/// Both ends on their own side of the chord between the two rim corners that they share: no triangle is folded.
Ends first_guess(const Fans& fans) {
  const StarPolygon polygon = fans.polygon();
  Ends ends{mean_of_rim(fans, true), mean_of_rim(fans, false)};
  // What lies on the boundary lies on the diameter, below the other end.
  if (fans.a_on_boundary) ends.a = {fans.b_on_boundary ? ends.a.x : ends.b.x, 0};
  if (fans.b_on_boundary) ends.b = {fans.a_on_boundary ? ends.b.x : ends.a.x, 0};
  const auto between_chord_and = [&](const Vec2d& other) {
    return (polygon.corner(fans.shared_of_a.before) + polygon.corner(fans.shared_of_a.behind) + other) / 3;
  };
  if (count_slices(fans, true) == 1 && !fans.a_on_boundary) ends.a = between_chord_and(ends.b);
  if (count_slices(fans, false) == 1 && !fans.b_on_boundary) ends.b = between_chord_and(ends.a);
  return ends;
}

/// Places both ends so that the isometric distortion of all affected domain triangles in the polygon is least: Newton
/// steps on one and the other in turn, along the diameter where the end lies on the boundary.
Ends place_ends(const Energy& energy, const Fans& fans) {
  constexpr int kRounds = 8;
  const StarPolygon polygon = fans.polygon();
  const RestShape rest = equilateral();
  Ends ends = first_guess(fans);
  Wedges wedges;
  const auto improve = [&](bool of_a) {
    Vec2d& mine = of_a ? ends.a : ends.b;
    const Vec2d& other = of_a ? ends.b : ends.a;
    const Fans::Shared& shared = of_a ? fans.shared_of_a : fans.shared_of_b;
    wedges.start(1);
    for (int m = 0; m < fans.count(); ++m) {
      if (fans.slices[m].of_a == of_a) wedges.add(rest, 0, polygon.corner(m) - mine, polygon.corner(m + 1) - mine);
    }
    if (shared.behind >= 0) {
      wedges.add(rest, 0, polygon.corner(shared.behind) - mine, other - mine);
    }
    if (shared.before >= 0) {
      wedges.add(rest, 0, other - mine, polygon.corner(shared.before) - mine);
    }
    wedges.close();
    const bool slides = of_a ? fans.a_on_boundary : fans.b_on_boundary;
    const NewtonStep newton = slides ? newton_step_along(energy, wedges, {1, 0}) : newton_step(energy, wedges);
    if (energy_at(energy, wedges, newton.step) < newton.energy) mine += newton.step;
  };
  for (int round = 0; round < kRounds; ++round) {
    improve(true);
    improve(false);
  }
  return ends;
}

/// Every source vertex that the collapse moves, laid out in the polygon.
StarLayout lay_out(const WorkingMap& map, const Fans& fans, const Ends& ends) {
  const StarPolygon polygon = fans.polygon();
  StarLayout layout;
  const auto add = [&](DomainTriangleId t, const std::array<Vec2d, 3>& corners) {
    for (VertexId v = map.first_in[t]; v >= 0; v = map.next_in[v]) {
      if (map.pin[v] >= 0) continue;
      const auto w = barycentrics(map.at[v]);
      layout.vertices.push_back(v);
      layout.at.push_back(corners[0] * w[0] + corners[1] * w[1] + corners[2] * w[2]);
    }
  };
  const auto corners_from = [](int corner, const Vec2d& first, const Vec2d& second, const Vec2d& third) {
    std::array<Vec2d, 3> corners;
    corners[corner] = first;
    corners[(corner + 1) % 3] = second;
    corners[(corner + 2) % 3] = third;
    return corners;
  };
  for (int m = 0; m < fans.count(); ++m) {
    const auto& [c, of_a] = fans.slices[m];
    add(c.triangle, corners_from(c.corner, of_a ? ends.a : ends.b, polygon.corner(m), polygon.corner(m + 1)));
  }
  add(fans.side.triangle, corners_from(fans.side.side, ends.a, ends.b, polygon.corner(fans.shared_of_a.before)));
  if (fans.across.exists()) {
    add(fans.across.triangle, corners_from(fans.across.side, ends.b, ends.a, polygon.corner(fans.shared_of_a.behind)));
  }
  const auto add_anchor = [&](DomainVertex n, const Vec2d& at) {
    if (map.anchor[n] < 0) return;
    layout.vertices.push_back(map.anchor[n]);
    layout.at.push_back(at);
  };
  add_anchor(fans.a, ends.a);
  add_anchor(fans.b, ends.b);
  return layout;
}

/// The domain triangles that vanish.
std::vector<DomainTriangleId> vanishing(const Fans& fans) {
  if (!fans.across.exists()) return {fans.side.triangle};
  return {fans.side.triangle, fans.across.triangle};
}

/// Both fans and what vanishes.
Region region_of(const WorkingMap& map, const Fans& fans, const StarLayout& layout) {
  Region region;
  region.moving = layout.vertices;
  region.triangles = vanishing(fans);
  const auto add_rim = [&](const Slice& s, int corner) {
    region.rim.push_back(map.domain.corner(s.corner.triangle, (s.corner.corner + corner) % 3));
  };
  for (const Slice& s : fans.slices) {
    region.triangles.push_back(s.corner.triangle);
    add_rim(s, 1);
  }
  if (fans.on_boundary) add_rim(fans.slices.back(), 2);
  return region;
}

/// Joins the two triangles across the other two sides of a triangle that vanishes.
void close_over(Domain& domain, DomainSide side) {
  const DomainSide p = domain.neighbour({side.triangle, (side.side + 1) % 3});
  const DomainSide q = domain.neighbour({side.triangle, (side.side + 2) % 3});
  if (p.exists()) domain.triangles[p.triangle].neighbours[p.side] = q;
  if (q.exists()) domain.triangles[q.triangle].neighbours[q.side] = p;
}

/// Carries out the collapse on the domain alone. Vertices pinned to a or b become free; those pinned to the rim find
/// another corner.
void collapse_domain(WorkingMap& map, const Fans& fans, Checkpoint& checkpoint) {
  const std::vector<DomainTriangleId> gone = vanishing(fans);
  std::vector<VertexId> displaced;
  for (const DomainTriangleId t : gone) {
    checkpoint.keep_triangle(t);
    for (VertexId v = map.first_in[t]; v >= 0; v = map.next_in[v]) {
      const DomainVertex n = map.pin[v];
      if (n < 0 || n == fans.a || n == fans.b) continue;
      displaced.push_back(v);
      checkpoint.keep_vertex(v);
      for_each_outgoing(map.mesh, v, [&](Halfedge h) { checkpoint.keep_charts(h / 3); });
    }
  }
  for (const Slice& s : fans.slices) checkpoint.keep_triangle(s.corner.triangle);
  for (const DomainVertex n : {fans.a, fans.b}) {
    if (map.anchor[n] >= 0) unpin(map, map.anchor[n]);
  }
  close_over(map.domain, fans.side);
  if (fans.across.exists()) close_over(map.domain, fans.across);
  for (const DomainTriangleId t : gone) map.domain.triangles[t] = {};
  map.domain_faces -= static_cast<std::int32_t>(gone.size());
  for (const auto& [c, of_a] : fans.slices) map.domain.triangles[c.triangle].corners[c.corner] = fans.kept;
  for (const auto& [c, of_a] : fans.slices) {
    for (int i = 0; i < 3; ++i) map.corner_of[map.domain.corner(c.triangle, i)] = {c.triangle, i};
  }
  map.corner_of[fans.gone] = {};
  // Slice m of the layout starts at the polygon's corner m, and so must the star's first triangle.
  map.corner_of[fans.kept] = fans.slices.front().corner;
  for (const VertexId v : displaced) renew_pin(map, v);
}

/// How uneven the regions and paths around the new vertex would be with its centre at `centre` (Sec. 5.3): the spread
/// of the areas of its slices, and of the lengths of its spokes, each as a share of their mean. Lengths follow equation
/// (5) in the polygon.
double unevenness(const WorkingMap& map, const SurfaceMeasures& measures, const StarLayout& layout,
                  const Numbering& index, const StarPolygon& polygon, const Vec2d& centre) {
  const int k = polygon.slices;
  std::vector<Vec2d> rim;
  for (int m = 0; m < (polygon.is_half ? k + 1 : k); ++m) rim.push_back(polygon.corner(m) - centre);
  std::vector<int> slice(layout.vertices.size());
  std::vector<double> area(k, 0), length(k, 0);
  for (std::size_t i = 0; i < slice.size(); ++i) {
    const Vec2d p = layout.at[i] - centre;
    int best = 0;
    for (int m = 0; m < k; ++m) {
      if (cross(rim[m], p) >= 0 && cross(p, rim[polygon.after(m)]) >= 0) best = m;
    }
    slice[i] = best;
    area[best] += measures.vertex_area[layout.vertices[i]];
  }
  for (std::size_t i = 0; i < slice.size(); ++i) {
    for_each_outgoing(map.mesh, layout.vertices[i], [&](Halfedge h) {
      const VertexId u = map.mesh.end(h), w = map.mesh.opposite(h);
      const int p = index.find(u);
      const int q = index.find(w);
      if (p < 0 || q < 0 || slice[p] != slice[q] || slice[p] == slice[i]) return;
      int spoke = -1;
      if (polygon.after(slice[p]) == slice[i]) spoke = slice[i];
      else if (polygon.after(slice[i]) == slice[p]) spoke = slice[p];
      const Vec2d e = layout.at[q] - layout.at[p];
      if (spoke < 0 || !(e.length() > 0)) return;
      const double in_space = Vec3d((*map.positions)[u] - (*map.positions)[w]).length();
      length[spoke] += in_space * std::abs(e.normalized().dot(rim[spoke].normalized())) / 2;
    });
  }
  const auto spread = [](const std::vector<double>& values) {
    double sum = 0;
    for (const double x : values) sum += x;
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    return sum > 0 ? (*high - *low) * static_cast<double>(values.size()) / sum : 0;
  };
  return spread(area) + spread(length);
}

/// Layout vertices that may become the centre, the most promising first.
std::vector<std::size_t> rank_centres(const WorkingMap& map, const SurfaceMeasures& measures, const StarLayout& layout,
                                      const StarPolygon& polygon, const Vec3d& embedded) {
  constexpr std::size_t kMostCandidates = 6;
  const std::size_t n = layout.vertices.size();
  std::vector<std::pair<double, std::size_t>> ranked;
  ranked.reserve(n);
  const bool warm = n > static_cast<std::size_t>(polygon.slices) * kWarmVertices / 3;
  for (std::size_t i = 0; i < n; ++i) {
    if (!may_be_centre(map, polygon, layout, i)) continue;
    const double distance =
        warm ? layout.at[i].length2() : (Vec3d((*map.positions)[layout.vertices[i]]) - embedded).length2();
    ranked.emplace_back(distance, i);
  }
  const std::size_t kept = std::min(ranked.size(), kMostCandidates);
  std::partial_sort(ranked.begin(), ranked.begin() + static_cast<std::ptrdiff_t>(kept), ranked.end());
  ranked.resize(kept);
  if (warm) {
    thread_local Numbering index;
    index.clear(map.home.size());
    for (std::size_t i = 0; i < n; ++i) index.set(layout.vertices[i], static_cast<std::int32_t>(i));
    for (auto& [score, i] : ranked) score = unevenness(map, measures, layout, index, polygon, layout.at[i]);
    std::sort(ranked.begin(), ranked.end());
  }
  std::vector<std::size_t> order;
  for (const auto& candidate : ranked) order.push_back(candidate.second);
  return order;
}

std::size_t position_of(const StarLayout& layout, VertexId v) {
  return static_cast<std::size_t>(std::find(layout.vertices.begin(), layout.vertices.end(), v) -
                                  layout.vertices.begin());
}

}  // namespace

namespace {

/// The vertices that sides join to `n`, as often as they do.
std::vector<DomainVertex> neighbours_of(const WorkingMap& map, DomainVertex n) {
  std::vector<DomainVertex> found;
  const std::vector<DomainCorner> star = star_of(map, n);
  const auto corner = [&](const DomainCorner& c, int i) { return map.domain.corner(c.triangle, (c.corner + i) % 3); };
  for (const DomainCorner& c : star) found.push_back(corner(c, 1));
  if (next_around(map.domain, star.back()).triangle < 0) found.push_back(corner(star.back(), 2));
  return found;
}

/// The ends have no neighbours in common but those opposite the side, and no other side joins them.
bool fulfils_link_condition(const WorkingMap& map, const Fans& fans, const std::vector<DomainVertex>& opposite) {
  const auto without = [](std::vector<DomainVertex> vertices, DomainVertex n) {
    const auto found = std::find(vertices.begin(), vertices.end(), n);
    if (found != vertices.end()) vertices.erase(found);
    return vertices;
  };
  std::vector<DomainVertex> of_a = without(neighbours_of(map, fans.a), fans.b);
  std::vector<DomainVertex> of_b = without(neighbours_of(map, fans.b), fans.a);
  for (const DomainVertex n : opposite) {
    of_a = without(std::move(of_a), n);
    of_b = without(std::move(of_b), n);
  }
  return std::find(of_a.begin(), of_a.end(), fans.b) == of_a.end() &&
         std::none_of(of_b.begin(), of_b.end(),
                      [&](DomainVertex n) { return std::find(of_a.begin(), of_a.end(), n) != of_a.end(); });
}

/// A collapse along a side takes nothing from the boundary's other sides, and no user's cone from where it is.
bool keeps_boundary(const WorkingMap& map, const Fans& fans) {
  if (!fans.on_boundary) return true;
  if (fans.across.exists()) {
    if (fans.a_on_boundary && fans.b_on_boundary) return false;
    return map.kept[fans.a_on_boundary ? fans.b : fans.a] == 0;
  }
  // An ear's tip has no triangle but the one that vanishes.
  return count_slices(fans, true) > 0 && count_slices(fans, false) > 0;
}

}  // namespace

bool can_collapse(const WorkingMap& map, DomainSide side) {
  const Fans fans = find_fans(map, side);
  if (map.kept[fans.a] && map.kept[fans.b]) return false;
  if (!keeps_boundary(map, fans)) return false;
  // A half polygon of one slice is flat.
  const int least = fans.on_boundary ? 2 : 3;
  if (fans.count() < least || fans.count() > (fans.on_boundary ? kMostValenceOnBoundary : kMostValence)) return false;
  std::vector<DomainVertex> opposite{map.domain.corner(side.triangle, (side.side + 2) % 3)};
  if (fans.across.exists()) {
    opposite.push_back(map.domain.corner(fans.across.triangle, (fans.across.side + 2) % 3));
    if (opposite[0] == opposite[1]) return false;
  }
  for (const DomainVertex n : opposite) {
    if (const Valence v = valence(map, n); v.triangles <= v.least()) return false;
  }
  return fulfils_link_condition(map, fans, opposite);
}

DomainVertex surviving_vertex(const WorkingMap& map, DomainSide side) {
  return surviving_end(map, map.domain.start(side), map.domain.end(side));
}

double collapse_cost(const WorkingMap& map, const SurfaceMeasures& measures, DomainSide side) {
  const double length = path_length(map, measures, side);
  const DomainSide across = map.domain.neighbour(side);
  return region_area(map, measures, side.triangle) +
         (across.exists() ? region_area(map, measures, across.triangle) : 0) + length * length;
}

bool collapse(WorkingMap& map, SurfaceMeasures& measures, DomainSide side, const CollapseOptions& options) {
  Checkpoint undo(map);
  double rise = 0;
  return collapse(map, measures, side, options, undo, rise);
}

bool collapse(WorkingMap& map, SurfaceMeasures& measures, DomainSide side, const CollapseOptions& options,
              Checkpoint& checkpoint, double& rise) {
  for (const DomainSide s : {side, map.domain.neighbour(side)}) {
    if (!s.exists()) continue;
    const DomainVertex opposite = map.domain.corner(s.triangle, (s.side + 2) % 3);
    if (valence(map, opposite).is_regular() && !ensure_anchor(map, opposite)) return false;
  }
  const Fans fans = find_fans(map, side);
  const StarPolygon polygon = fans.polygon();
  const Ends ends = place_ends(map.energy, fans);
  const StarLayout layout = lay_out(map, fans, ends);
  if (layout.vertices.empty()) return false;
  std::vector<Hanging> hanging;
  if (!find_surroundings(map, region_of(map, fans, layout), hanging)) return false;
  const Vec3d embedded = measures.warming_up ? embed_collapsed_vertex(map, measures, side) : Vec3d(0, 0, 0);

  for (const Slice& s : fans.slices) {
    for (int i = 0; i < 3; ++i) checkpoint.keep_domain_vertex(map.domain.corner(s.corner.triangle, i));
  }
  for (const DomainVertex n : {fans.a, fans.b}) checkpoint.keep_domain_vertex(n);
  keep_layout(checkpoint, fans.kept, layout, hanging);

  const auto fewer = static_cast<std::int32_t>(vanishing(fans).size());
  map.domain_faces -= fewer;
  const double before = energy_of(map, hanging);
  map.domain_faces += fewer;
  const bool kept = map.kept[fans.kept];
  const std::vector<std::size_t> centres = kept ? std::vector<std::size_t>{position_of(layout, map.anchor[fans.kept])}
                                                : rank_centres(map, measures, layout, polygon, embedded);
  bool done = false;
  for (std::size_t i = 0; i < centres.size() && !done; ++i) {
    if (i > 0) checkpoint.restore();
    collapse_domain(map, fans, checkpoint);
    const std::size_t centre = centres[i];
    const bool pin = options.pin_regular || !valence(map, fans.kept).is_regular() || kept;
    done = embed_star(map, fans.kept, layout, hanging, layout.at[centre], pin ? layout.vertices[centre] : -1,
                      options.relax);
  }
  if (!done) {
    checkpoint.restore();
    return false;
  }
  measures.embedding[fans.kept] = embedded;
  rise = energy_of(map, hanging) - before;
  return true;
}

}  // namespace lozenge
