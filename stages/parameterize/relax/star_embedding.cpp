// Every vertex of the layout goes to the slice it lies in, now that the slices meet in the new centre, and to the place
// of that slice's triangle that its barycentric weights say; on the boundary along the diameter or the rim. Where a
// triangle came out folded, its corners move into the kernels around them; then all of it relaxes.
#include "stages/parameterize/relax/star_embedding.h"

#include <optional>
#include <vector>

#include "stages/parameterize/map/homes.h"
#include "stages/parameterize/map/pins.h"
#include "stages/parameterize/map/star.h"
#include "stages/parameterize/relax/slice_charts.h"
#include "stages/parameterize/relax/star_slices.h"

namespace lozenge {

bool embed_star(LocalChange& change, DomainVertex n, const StarLayout& layout, const Vec2d& centre, VertexId anchor,
                const RelaxOptions& options) {
  WorkingMap& map = change.map();
  const std::vector<DomainCorner> star = star_of(map, n);
  const StarPolygon polygon = polygon_of(map, star);
  if (const VertexId old = map.anchor[n]; old >= 0) unpin(map, old);
  std::vector<int> slices(layout.vertices.size(), 0);
  const StarSlices slices_around(polygon, centre);
  const auto has_neighbour = [&](int slice) {
    return map.domain.neighbour({star[slice].triangle, (star[slice].corner + 1) % 3}).exists();
  };
  const auto find = [&](VertexId v, const Vec2d& at) -> std::optional<StarSlice> {
    if (!map.mesh.on_boundary(v)) return slices_around.find(at);
    if (polygon.is_on_diameter(at)) return slices_around.find_on_diameter(at);
    return slices_around.find_on_rim(at, has_neighbour);
  };
  for (std::size_t i = 0; i < layout.vertices.size(); ++i) {
    const VertexId v = layout.vertices[i];
    if (v == anchor) continue;
    const auto w = find(v, layout.at[i]);
    if (!w) return false;
    const DomainCorner c = star[w->slice];
    slices[i] = w->slice;
    set_home(map, v, c.triangle, from_corner_frame(c.corner)(at_barycentrics(w->first, w->second)));
  }
  if (anchor >= 0) pin_to(map, anchor, n);
  make_star_charts(map, star, layout, slices, change.surroundings(), centre, anchor, change.scratch().places);
  if (!heal_folds(map, layout.vertices) || !are_consistent(map, change.surroundings())) return false;
  relax(map, layout.vertices, options);
  return true;
}

}  // namespace lozenge
