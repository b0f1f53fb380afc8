#include "stages/import/fans.h"

namespace lozenge {

namespace {

HalfEdge next_in_triangle(HalfEdge h) { return h % 3 == 2 ? h - 2 : h + 1; }
HalfEdge previous_in_triangle(HalfEdge h) { return h % 3 == 0 ? h + 2 : h - 1; }

}  // namespace

Fans find_fans(const SourceMesh& mesh, const std::vector<HalfEdge>& twins) {
  Fans fans;
  fans.of_corner.assign(twins.size(), -1);
  for (std::size_t i = 0; i < twins.size(); ++i) {
    if (fans.of_corner[i] >= 0) continue;
    const auto first = static_cast<HalfEdge>(i);
    const auto fan = static_cast<std::int32_t>(fans.vertices.size());
    fans.vertices.push_back(half_edge_start(mesh, first));
    // One way around until the circle closes or the boundary comes; then the other way, which finds nothing new in a
    // closed circle.
    for (HalfEdge h = first; h >= 0 && fans.of_corner[h] < 0; h = twins[previous_in_triangle(h)]) {
      fans.of_corner[h] = fan;
    }
    for (HalfEdge h = twins[first]; h >= 0 && fans.of_corner[next_in_triangle(h)] < 0; h = twins[next_in_triangle(h)]) {
      fans.of_corner[next_in_triangle(h)] = fan;
    }
  }
  return fans;
}

}  // namespace lozenge
