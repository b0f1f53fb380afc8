// Each triangle of the star is a slice of the polygon; a vertex at home there lies in the slice where its barycentric
// weights put it, in the shape that the star has.
#include "stages/parameterize/relax/star_layout.h"

#include <algorithm>

namespace lozenge {

Region region_of(const WorkingMap& map, const std::vector<DomainCorner>& star, const StarLayout& layout) {
  Region region;
  region.moving = layout.vertices;
  for (const DomainCorner& c : star) {
    region.triangles.push_back(c.triangle);
    region.rim.push_back(map.domain.corner(c.triangle, (c.corner + 1) % 3));
  }
  const DomainCorner& last = star.back();
  if (polygon_of(map, star).is_half) region.rim.push_back(map.domain.corner(last.triangle, (last.corner + 2) % 3));
  return region;
}

StarPolygon polygon_of(const WorkingMap& map, const std::vector<DomainCorner>& star) {
  return {static_cast<int>(star.size()), next_around(map.domain, star.back()).triangle < 0};
}

bool may_be_centre(const WorkingMap& map, const StarPolygon& polygon, const StarLayout& layout, std::size_t place) {
  return map.mesh.on_boundary(layout.vertices[place]) == polygon.is_half &&
         (!polygon.is_half || polygon.is_on_diameter(layout.at[place]));
}

std::vector<std::size_t> nearest_in_layout(const WorkingMap& map, const StarPolygon& polygon, const StarLayout& layout,
                                           const Vec2d& p, std::size_t most) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < layout.vertices.size(); ++i) {
    if (may_be_centre(map, polygon, layout, i)) order.push_back(i);
  }
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

StarLayout lay_out_star(const WorkingMap& map, const std::vector<DomainCorner>& star, StarShape shape) {
  StarLayout layout;
  const StarPolygon polygon = polygon_of(map, star);
  const DomainVertex n = map.domain.corner(star.front().triangle, star.front().corner);
  for (int slice = 0; slice < polygon.slices; ++slice) {
    const DomainCorner c = star[slice];
    for (VertexId v = map.first_in[c.triangle]; v >= 0; v = map.next_in[v]) {
      if (map.pin[v] >= 0) continue;
      const auto w = barycentrics(map.at[v]);
      layout.add(v, polygon.point({slice, w[(c.corner + 1) % 3], w[(c.corner + 2) % 3]}, shape));
    }
  }
  if (const VertexId v = map.anchor[n]; v >= 0) layout.add(v, Vec2d(0, 0));
  return layout;
}

}  // namespace lozenge
