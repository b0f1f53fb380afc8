#include "stages/parameterize/star_embedding.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "formats/interpolation_domain.h"
#include "stages/parameterize/wedge.h"

namespace lozenge {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Where a point of the polygon lies when the slices meet in `centre`.
StarSlice find_slice(int valence, const Vec2d& centre, const Vec2d& p) {
  StarSlice best;
  double least = -kInfinity;
  for (int i = 0; i < valence; ++i) {
    const Vec2d a = star_corner(valence, i) - centre;
    const Vec2d b = star_corner(valence, i + 1) - centre;
    const double area = cross(a, b);
    const Vec2d q = p - centre;
    const StarSlice here{i, cross(q, b) / area, cross(a, q) / area};
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

/// The triangles that touch one of the vertices, ascending.
std::vector<TriangleId> triangles_around(const WorkingMap& map, const std::vector<VertexId>& vertices) {
  std::vector<TriangleId> triangles;
  for (const VertexId v : vertices) {
    for_each_outgoing(map.mesh, v, [&](Halfedge h) { triangles.push_back(h / 3); });
  }
  std::sort(triangles.begin(), triangles.end());
  triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
  return triangles;
}

/// Flat relaxation inside the polygon (5.2 on a star domain): vertices whose whole ring lies in the layout move, the
/// others are the fixed boundary.
class PolygonProblem {
 public:
  PolygonProblem(const WorkingMap& map, StarLayout& layout) : map_(map), layout_(layout) {
    const auto most = *std::max_element(layout.vertices.begin(), layout.vertices.end());
    index_.assign(static_cast<std::size_t>(most) + 1, -1);
    for (std::size_t i = 0; i < layout.vertices.size(); ++i) index_[layout.vertices[i]] = static_cast<int>(i);
  }

  void relax_all(int sweeps) {
    for (int sweep = 0; sweep < sweeps; ++sweep) {
      for (std::size_t i = 0; i < layout_.vertices.size(); ++i) relax_one(i);
    }
  }

 private:
  int find(VertexId v) const { return v < static_cast<VertexId>(index_.size()) ? index_[v] : -1; }

  void relax_one(std::size_t i) {
    const VertexId v = layout_.vertices[i];
    ring_.clear();
    bool inside = true;
    for_each_outgoing(map_.mesh, v, [&](Halfedge h) {
      const int j = find(map_.mesh.end(h));
      const int k = find(map_.mesh.opposite(h));
      inside = inside && j >= 0 && k >= 0;
      if (inside) ring_.push_back(make_wedge(map_.rest[h / 3], h % 3, layout_.at[j], layout_.at[k], map_.scale()));
    });
    if (!inside) return;
    const Vec2d x = layout_.at[i];
    const double before = energy_at(map_.energy, ring_, x);
    if (!(before < kInfinity)) return;
    const Vec2d to = x + newton_step(map_.energy, ring_, x);
    if (energy_at(map_.energy, ring_, to) < before) layout_.at[i] = to;
  }

  const WorkingMap& map_;
  StarLayout& layout_;
  std::vector<int> index_;
  Wedges ring_;
};

/// The layout's vertices by their distance to a point, nearest first; at most `most` of them.
std::vector<std::size_t> nearest_in_layout(const StarLayout& layout, const Vec2d& p, std::size_t most) {
  std::vector<std::size_t> order(layout.vertices.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
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

/// From another shape of the star back to the polygon with linear slices, whose centre can be moved.
void straighten(StarLayout& layout, int valence, StarShape shape) {
  if (shape.conformality == 0) return;
  for (Vec2d& p : layout.at) p = point_in_star(valence, slice_in_star(valence, p, shape), {});
}

void keep_layout(Checkpoint& checkpoint, DomainVertex n, const StarLayout& layout) {
  checkpoint.keep_domain_vertex(n);
  for (const VertexId v : layout.vertices) checkpoint.keep_vertex(v);
}

}  // namespace

std::vector<DomainCorner> star_of(const WorkingMap& map, DomainVertex n) {
  return corners_around(map.domain, map.corner_of[n]);
}

StarLayout lay_out_star(const WorkingMap& map, const std::vector<DomainCorner>& star, StarShape shape) {
  StarLayout layout;
  const int k = static_cast<int>(star.size());
  const DomainVertex n = map.domain.corner(star.front().triangle, star.front().corner);
  for (int slice = 0; slice < k; ++slice) {
    const DomainCorner c = star[slice];
    for (VertexId v = map.first_in[c.triangle]; v >= 0; v = map.next_in[v]) {
      if (map.pin[v] >= 0) continue;
      const auto w = barycentrics(map.at[v]);
      layout.vertices.push_back(v);
      layout.at.push_back(point_in_star(k, {slice, w[(c.corner + 1) % 3], w[(c.corner + 2) % 3]}, shape));
    }
  }
  if (const VertexId v = map.anchor[n]; v >= 0) {
    layout.vertices.push_back(v);
    layout.at.push_back(Vec2d(0, 0));
  }
  return layout;
}

bool embed_star(WorkingMap& map, DomainVertex n, const StarLayout& layout, const Vec2d& centre, VertexId anchor,
                const RelaxOptions& options) {
  const std::vector<DomainCorner> star = star_of(map, n);
  const int k = static_cast<int>(star.size());
  if (const VertexId old = map.anchor[n]; old >= 0) unpin(map, old);
  for (std::size_t i = 0; i < layout.vertices.size(); ++i) {
    const VertexId v = layout.vertices[i];
    if (v == anchor) continue;
    const StarSlice w = find_slice(k, centre, layout.at[i]);
    const DomainCorner c = star[w.slice];
    set_home(map, v, c.triangle, from_corner_frame(c.corner, at_barycentrics(w.first, w.second)));
  }
  if (anchor >= 0) pin_to(map, anchor, n);
  if (!heal_folds(map, layout.vertices)) return false;
  relax(map, layout.vertices, options);
  return true;
}

bool ensure_anchor(WorkingMap& map, DomainVertex n) {
  if (map.anchor[n] >= 0) return true;
  const StarLayout layout = lay_out_star(map, star_of(map, n), {});
  for (const std::size_t i : nearest_in_layout(layout, {0, 0}, 3)) {
    Checkpoint checkpoint(map);
    keep_layout(checkpoint, n, layout);
    if (embed_star(map, n, layout, layout.at[i], layout.vertices[i], {2, 0})) return true;
    checkpoint.restore();
  }
  return false;
}

double optimize_cone(WorkingMap& map, DomainVertex n, const RelaxOptions& options) {
  const std::vector<DomainCorner> star = star_of(map, n);
  StarLayout layout = lay_out_star(map, star, {map.star_conformality});
  if (layout.vertices.size() < 2) return 0;
  const double before = energy_around(map, layout.vertices);
  Checkpoint checkpoint(map);
  keep_layout(checkpoint, n, layout);
  PolygonProblem(map, layout).relax_all(4);
  straighten(layout, static_cast<int>(star.size()), {map.star_conformality});
  const auto nearest = nearest_in_layout(layout, {0, 0}, 2);
  for (const std::size_t i : nearest) {
    if (layout.vertices[i] == map.anchor[n]) continue;
    if (embed_star(map, n, layout, layout.at[i], layout.vertices[i], options)) {
      const double after = energy_around(map, layout.vertices);
      if (after < before) return before - after;
    }
    checkpoint.restore();
  }
  return 0;
}

double energy_around(const WorkingMap& map, const std::vector<VertexId>& vertices) {
  double sum = 0;
  for (const TriangleId t : triangles_around(map, vertices)) sum += triangle_energy(map, t);
  return sum;
}

}  // namespace lozenge
