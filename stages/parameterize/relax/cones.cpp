// The star is laid out in a polygon whose centre is nothing but another point: everything inside relaxes there, flat.
// The vertex that comes to lie nearest to the centre becomes the cone, and the star is mapped back around it.
#include "stages/parameterize/relax/cones.h"

#include <limits>
#include <vector>

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
  PolygonProblem(const WorkingMap& map, StarLayout& layout, Numbering& places)
      : map_(map), layout_(layout), number_(places) {
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
  Numbering& number_;  ///< [vertex] its place in the layout
};

/// From another shape of the star back to the polygon with linear slices, whose centre can be moved.
void straighten(StarLayout& layout, const StarPolygon& polygon, StarShape shape) {
  if (shape.conformality == 0) return;
  for (Vec2d& p : layout.at) p = polygon.point(polygon.slice_at(p, shape), {});
}

}  // namespace

std::optional<double> optimize_cone(LocalChange& change, DomainVertex n, const RelaxOptions& options) {
  constexpr int kSweepsInPolygon = 4;    // it settles later, where its true distortion is seen
  constexpr std::size_t kMostTried = 2;  // the nearest often is the one that is there
  WorkingMap& map = change.map();
  if (map.kept[n]) return std::nullopt;
  const std::vector<DomainCorner> star = star_of(map, n);
  const StarPolygon polygon = polygon_of(map, star);
  if (polygon.is_half) return crawl(change, n);
  StarLayout layout = lay_out_star(map, star, {map.star_conformality});
  if (layout.vertices.size() < 2 || !change.open(region_of(map, star, layout))) return std::nullopt;
  change.keep_domain_vertex(n);
  change.measure_before();
  PolygonProblem(map, layout, change.scratch().places).relax_all(kSweepsInPolygon);
  straighten(layout, polygon, {map.star_conformality});
  const auto is_better = [&](std::size_t i) {
    return layout.vertices[i] != map.anchor[n] &&
           embed_star(change, n, layout, layout.at[i], layout.vertices[i], options) &&
           change.energy() < change.before();
  };
  if (!change.carry_out_first(nearest_in_layout(map, polygon, layout, {0, 0}, kMostTried), is_better))
    return std::nullopt;
  return change.rise();
}

std::optional<double> optimize_cone(WorkingMap& map, DomainVertex n, const RelaxOptions& options, Scratch& scratch) {
  return carry_out(map, scratch, [&](LocalChange& change) { return optimize_cone(change, n, options); });
}

}  // namespace lozenge
