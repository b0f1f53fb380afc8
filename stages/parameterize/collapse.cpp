#include "stages/parameterize/collapse.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "formats/interpolation_domain.h"
#include "stages/parameterize/star_embedding.h"
#include "stages/parameterize/warm_up.h"
#include "stages/parameterize/wedge.h"

namespace lozenge {

namespace {

/// The two fans that become one star. Slices are numbered counter-clockwise around it: those of a first, then those of
/// b. Corner m of the rim starts slice m; corner 0 lies opposite the side in its own triangle.
struct Fans {
  DomainVertex a, b;
  DomainSide side, across;
  std::vector<DomainCorner> around_a, around_b;  ///< without the two triangles that vanish

  int slices_of_a() const { return static_cast<int>(around_a.size()); }
  int slices() const { return static_cast<int>(around_a.size() + around_b.size()); }
};

Fans find_fans(const WorkingMap& map, DomainSide side) {
  Fans fans{map.domain.start(side), map.domain.end(side), side, map.domain.neighbour(side), {}, {}};
  const auto without_ends = [](std::vector<DomainCorner> around) {
    return std::vector<DomainCorner>(around.begin() + 1, around.end() - 1);
  };
  fans.around_a = without_ends(corners_around(map.domain, {side.triangle, side.side}));
  fans.around_b = without_ends(corners_around(map.domain, {fans.across.triangle, fans.across.side}));
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

Vec2d mean_of_rim(int valence, int first, int last) {
  Vec2d sum(0, 0);
  for (int m = first; m <= last; ++m) sum += star_corner(valence, m);
  return sum / (last - first + 1);
}

/// Both ends on their own side of the chord between the two rim corners that they share: no triangle is folded.
Ends first_guess(const Fans& fans) {
  const int k = fans.slices();
  const int split = fans.slices_of_a();
  Ends ends{mean_of_rim(k, 0, split), mean_of_rim(k, split, k)};
  const Vec2d chord = star_corner(k, 0) + star_corner(k, split);
  if (split == 1) ends.a = (chord + ends.b) / 3;
  if (k - split == 1) ends.b = (chord + ends.a) / 3;
  return ends;
}

/// Places both ends so that the isometric distortion of all affected domain triangles in the polygon is least: Newton
/// steps on one and the other in turn.
Ends place_ends(const Energy& energy, const Fans& fans) {
  constexpr int kRounds = 8;
  const int k = fans.slices();
  const int split = fans.slices_of_a();
  const RestShape rest = equilateral();
  Ends ends = first_guess(fans);
  Wedges wedges;
  const auto improve = [&](Vec2d& mine, const Vec2d& other, int first, int last) {
    wedges.clear();
    for (int m = first; m < last; ++m)
      wedges.push_back(make_wedge(rest, 0, star_corner(k, m) - mine, star_corner(k, m + 1) - mine, 1));
    wedges.push_back(make_wedge(rest, 0, star_corner(k, last) - mine, other - mine, 1));
    wedges.push_back(make_wedge(rest, 0, other - mine, star_corner(k, first) - mine, 1));
    const NewtonStep newton = newton_step(energy, wedges);
    if (energy_at(energy, wedges, newton.step) < newton.energy) mine += newton.step;
  };
  for (int round = 0; round < kRounds; ++round) {
    improve(ends.a, ends.b, 0, split);
    improve(ends.b, ends.a, split, k);
  }
  return ends;
}

/// Every source vertex that the collapse moves, laid out in the polygon.
StarLayout lay_out(const WorkingMap& map, const Fans& fans, const Ends& ends) {
  const int k = fans.slices();
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
  for (int m = 0; m < k; ++m) {
    const bool of_a = m < fans.slices_of_a();
    const DomainCorner c = of_a ? fans.around_a[m] : fans.around_b[m - fans.slices_of_a()];
    add(c.triangle, corners_from(c.corner, of_a ? ends.a : ends.b, star_corner(k, m), star_corner(k, m + 1)));
  }
  add(fans.side.triangle, corners_from(fans.side.side, ends.a, ends.b, star_corner(k, 0)));
  add(fans.across.triangle, corners_from(fans.across.side, ends.b, ends.a, star_corner(k, fans.slices_of_a())));
  const auto add_anchor = [&](DomainVertex n, const Vec2d& at) {
    if (map.anchor[n] < 0) return;
    layout.vertices.push_back(map.anchor[n]);
    layout.at.push_back(at);
  };
  add_anchor(fans.a, ends.a);
  add_anchor(fans.b, ends.b);
  return layout;
}

/// Both fans and the two triangles that vanish.
Region region_of(const WorkingMap& map, const Fans& fans, const StarLayout& layout) {
  Region region;
  region.moving = layout.vertices;
  region.triangles = {fans.side.triangle, fans.across.triangle};
  for (const auto* around : {&fans.around_a, &fans.around_b}) {
    for (const DomainCorner& c : *around) {
      region.triangles.push_back(c.triangle);
      region.rim.push_back(map.domain.corner(c.triangle, (c.corner + 1) % 3));
    }
  }
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
  const std::array<DomainTriangleId, 2> gone{fans.side.triangle, fans.across.triangle};
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
  for (const auto* around : {&fans.around_a, &fans.around_b}) {
    for (const DomainCorner& c : *around) checkpoint.keep_triangle(c.triangle);
  }
  for (const DomainVertex n : {fans.a, fans.b}) {
    if (map.anchor[n] >= 0) unpin(map, map.anchor[n]);
  }
  close_over(map.domain, fans.side);
  close_over(map.domain, fans.across);
  for (const DomainTriangleId t : gone) map.domain.triangles[t] = {};
  map.domain_faces -= 2;
  for (const DomainCorner& c : fans.around_b) map.domain.triangles[c.triangle].corners[c.corner] = fans.a;
  for (const auto* around : {&fans.around_a, &fans.around_b}) {
    for (const DomainCorner& c : *around) {
      for (int i = 0; i < 3; ++i) map.corner_of[map.domain.corner(c.triangle, i)] = {c.triangle, i};
    }
  }
  map.corner_of[fans.b] = {};
  for (const VertexId v : displaced) renew_pin(map, v);
}

/// How uneven the regions and paths around the new vertex would be with its centre at `centre` (Sec. 5.3): the spread
/// of the areas of its slices, and of the lengths of its spokes, each as a share of their mean. Lengths follow equation
/// (5) in the polygon.
double unevenness(const WorkingMap& map, const SurfaceMeasures& measures, const StarLayout& layout,
                  const Numbering& index, int k, const Vec2d& centre) {
  std::vector<Vec2d> rim(k);
  for (int m = 0; m < k; ++m) rim[m] = star_corner(k, m) - centre;
  std::vector<int> slice(layout.vertices.size());
  std::vector<double> area(k, 0), length(k, 0);
  for (std::size_t i = 0; i < slice.size(); ++i) {
    const Vec2d p = layout.at[i] - centre;
    int best = 0;
    for (int m = 0; m < k; ++m) {
      if (cross(rim[m], p) >= 0 && cross(p, rim[(m + 1) % k]) >= 0) best = m;
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
      if ((slice[p] + 1) % k == slice[i]) spoke = slice[i];
      else if ((slice[i] + 1) % k == slice[p]) spoke = slice[p];
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
                                      int k, const Vec3d& embedded) {
  constexpr std::size_t kMostCandidates = 6;
  const std::size_t n = layout.vertices.size();
  std::vector<std::pair<double, std::size_t>> ranked(n);
  const bool warm = n > static_cast<std::size_t>(k) * kWarmVertices / 3;
  for (std::size_t i = 0; i < n; ++i) {
    const double distance =
        warm ? layout.at[i].length2() : (Vec3d((*map.positions)[layout.vertices[i]]) - embedded).length2();
    ranked[i] = {distance, i};
  }
  const std::size_t kept = std::min(n, kMostCandidates);
  std::partial_sort(ranked.begin(), ranked.begin() + static_cast<std::ptrdiff_t>(kept), ranked.end());
  ranked.resize(kept);
  if (warm) {
    thread_local Numbering index;
    index.clear(map.home.size());
    for (std::size_t i = 0; i < n; ++i) index.set(layout.vertices[i], static_cast<std::int32_t>(i));
    for (auto& [score, i] : ranked) score = unevenness(map, measures, layout, index, k, layout.at[i]);
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

bool can_collapse(const WorkingMap& map, DomainSide side) {
  const DomainSide across = map.domain.neighbour(side);
  if (!across.exists()) return false;
  const Fans fans = find_fans(map, side);
  if (map.kept[fans.a] && map.kept[fans.b]) return false;
  // find_fans leaves both vanishing triangles out: valence is slices + 2.
  if (fans.slices() < 3 || fans.slices() > kMostValence) return false;
  const DomainVertex c = map.domain.corner(side.triangle, (side.side + 2) % 3);
  const DomainVertex d = map.domain.corner(across.triangle, (across.side + 2) % 3);
  if (c == d || valence(map, c) <= 3 || valence(map, d) <= 3) return false;
  // Link condition: the ends have no neighbours in common but c and d.
  const auto rim = [&](const std::vector<DomainCorner>& around) {
    std::vector<DomainVertex> vertices;  // those strictly between the first and the last
    for (std::size_t i = 0; i + 1 < around.size(); ++i) {
      vertices.push_back(map.domain.corner(around[i].triangle, (around[i].corner + 2) % 3));
    }
    return vertices;
  };
  const std::vector<DomainVertex> of_a = rim(fans.around_a);
  for (const DomainVertex v : rim(fans.around_b)) {
    if (std::find(of_a.begin(), of_a.end(), v) != of_a.end()) return false;
  }
  return std::find(of_a.begin(), of_a.end(), fans.b) == of_a.end();
}

DomainVertex surviving_vertex(const WorkingMap& map, DomainSide side) {
  return map.kept[map.domain.end(side)] ? map.domain.end(side) : map.domain.start(side);
}

double collapse_cost(const WorkingMap& map, const SurfaceMeasures& measures, DomainSide side) {
  const double length = path_length(map, measures, side);
  return region_area(map, measures, side.triangle) + region_area(map, measures, map.domain.neighbour(side).triangle) +
         length * length;
}

bool collapse(WorkingMap& map, SurfaceMeasures& measures, DomainSide side, const CollapseOptions& options) {
  Checkpoint undo(map);
  double rise = 0;
  return collapse(map, measures, side, options, undo, rise);
}

bool collapse(WorkingMap& map, SurfaceMeasures& measures, DomainSide collapsed, const CollapseOptions& options,
              Checkpoint& checkpoint, double& rise) {
  // The vertex that stays is the side's start: where its end is kept, the side is taken from the other triangle.
  const bool from_start = surviving_vertex(map, collapsed) == map.domain.start(collapsed);
  const DomainSide side = from_start ? collapsed : map.domain.neighbour(collapsed);
  const DomainSide across = map.domain.neighbour(side);
  for (const DomainSide s : {side, across}) {
    const DomainVertex opposite = map.domain.corner(s.triangle, (s.side + 2) % 3);
    if (valence(map, opposite) == 6 && !ensure_anchor(map, opposite)) return false;
  }
  const Fans fans = find_fans(map, side);
  const int k = fans.slices();
  const Ends ends = place_ends(map.energy, fans);
  const StarLayout layout = lay_out(map, fans, ends);
  if (layout.vertices.empty()) return false;
  std::vector<Hanging> hanging;
  if (!find_surroundings(map, region_of(map, fans, layout), hanging)) return false;
  const Vec3d embedded = measures.warming_up ? embed_collapsed_vertex(map, measures, side) : Vec3d(0, 0, 0);

  for (const DomainCorner& c : fans.around_a) {
    for (int i = 0; i < 3; ++i) checkpoint.keep_domain_vertex(map.domain.corner(c.triangle, i));
  }
  for (const DomainCorner& c : fans.around_b) {
    for (int i = 0; i < 3; ++i) checkpoint.keep_domain_vertex(map.domain.corner(c.triangle, i));
  }
  keep_layout(checkpoint, fans.a, layout, hanging);

  map.domain_faces -= 2;
  const double before = energy_of(map, hanging);
  map.domain_faces += 2;
  const bool kept = map.kept[fans.a];
  const std::vector<std::size_t> centres = kept ? std::vector<std::size_t>{position_of(layout, map.anchor[fans.a])}
                                                : rank_centres(map, measures, layout, k, embedded);
  bool done = false;
  collapse_domain(map, fans, checkpoint);
  // Slice m of the layout starts at the polygon's corner m, and so must the star's first triangle.
  map.corner_of[fans.a] = fans.around_a.front();
  for (std::size_t i = 0; i < centres.size() && !done; ++i) {
    if (i > 0) {
      checkpoint.restore();
      collapse_domain(map, fans, checkpoint);
      map.corner_of[fans.a] = fans.around_a.front();
    }
    const std::size_t centre = centres[i];
    const bool pin = options.pin_regular || k != 6 || kept;
    done =
        embed_star(map, fans.a, layout, hanging, layout.at[centre], pin ? layout.vertices[centre] : -1, options.relax);
  }
  if (!done) {
    checkpoint.restore();
    return false;
  }
  measures.embedding[fans.a] = embedded;
  rise = energy_of(map, hanging) - before;
  return true;
}

}  // namespace lozenge
