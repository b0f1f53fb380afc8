// The star is laid out in a polygon whose centre is nothing but another point: everything inside relaxes there, flat.
// The vertex that comes to lie nearest to the centre becomes the cone, and the star is mapped back around it.
#include "stages/parameterize/relax/cones.h"

#include <limits>

#include "stages/parameterize/map/map_energy.h"
#include "stages/parameterize/map/marks.h"
#include "stages/parameterize/map/star.h"
#include "stages/parameterize/relax/crawl.h"
#include "stages/parameterize/relax/star_embedding.h"
#include "stages/parameterize/relax/wedge.h"

namespace lozenge {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Flat relaxation inside the polygon (5.2 on a star domain): vertices whose whole ring lies in the layout move, the
/// others stay, and so do those on the surface's boundary, which runs along the rim.
class PolygonProblem {
 public:
  PolygonProblem(const WorkingMap& map, StarLayout& layout) : map_(map), layout_(layout) {
    number_.clear(map.home.size());
    for (std::size_t i = 0; i < layout.vertices.size(); ++i) {
      number_.set(layout.vertices[i], static_cast<std::int32_t>(i));
    }
  }

  void relax_all(int sweeps) {
    for (int sweep = 0; sweep < sweeps; ++sweep) {
      for (std::size_t i = 0; i < layout_.vertices.size(); ++i) relax_one(i);
    }
  }

 private:
  void relax_one(std::size_t i) {
    const VertexId v = layout_.vertices[i];
    const Vec2d x = layout_.at[i];
    const double scale = map_.scale();
    ring_.start(scale);
    bool inside = !map_.mesh.on_boundary(v);
    for_each_outgoing(map_.mesh, v, [&](Halfedge h) {
      const int j = number_.find(map_.mesh.end(h));
      const int k = number_.find(map_.mesh.opposite(h));
      inside = inside && j >= 0 && k >= 0;
      if (inside) ring_.add(map_.rest[h / 3], h % 3, layout_.at[j] - x, layout_.at[k] - x);
    });
    if (!inside) return;
    ring_.close();
    const NewtonStep newton = newton_step(map_.energy, ring_);
    if (!(newton.energy < kInfinity)) return;
    if (energy_at(map_.energy, ring_, newton.step) < newton.energy) layout_.at[i] = x + newton.step;
  }

  const WorkingMap& map_;
  StarLayout& layout_;
  Wedges ring_;
  Numbering number_;  ///< [vertex] its place in the layout
};

/// From another shape of the star back to the polygon with linear slices, whose centre can be moved.
void straighten(StarLayout& layout, const StarPolygon& polygon, StarShape shape) {
  if (shape.conformality == 0) return;
  for (Vec2d& p : layout.at) p = polygon.point(polygon.slice_at(p, shape), {});
}

}  // namespace

double optimize_cone(WorkingMap& map, DomainVertex n, const RelaxOptions& options) {
  Checkpoint undo(map);
  return optimize_cone(map, n, options, undo);
}

double optimize_cone(WorkingMap& map, DomainVertex n, const RelaxOptions& options, Checkpoint& undo) {
  if (map.kept[n]) return 0;
  const std::vector<DomainCorner> star = star_of(map, n);
  const StarPolygon polygon = polygon_of(map, star);
  if (polygon.is_half) return crawl(map, n, undo);
  StarLayout layout = lay_out_star(map, star, {map.star_conformality});
  if (layout.vertices.size() < 2) return 0;
  std::vector<Hanging> hanging;
  if (!find_surroundings(map, region_of(map, star, layout), hanging)) return 0;
  const double before = energy_of(map, hanging);
  PolygonProblem(map, layout).relax_all(4);
  straighten(layout, polygon, {map.star_conformality});
  const auto nearest = nearest_in_layout(map, polygon, layout, {0, 0}, 2);
  for (const std::size_t i : nearest) {
    if (layout.vertices[i] == map.anchor[n]) continue;
    keep_layout(undo, n, layout, hanging);
    if (embed_star(map, n, layout, hanging, layout.at[i], layout.vertices[i], options)) {
      const double after = energy_of(map, hanging);
      if (after < before) return before - after;
    }
    undo.restore();
  }
  return 0;
}

}  // namespace lozenge
