#include "stages/import/fans.h"

namespace lozenge {

namespace {

HalfEdge next_in_triangle(HalfEdge h) { return h % 3 == 2 ? h - 2 : h + 1; }
HalfEdge previous_in_triangle(HalfEdge h) { return h % 3 == 0 ? h + 2 : h - 1; }

/// The half-edges that leave a vertex, from `first` on: one way around until the circle closes or the boundary comes;
/// then the other way from `first`. `visit` returns whether to go on that way.
template <typename Visit>
void for_each_in_fan(const std::vector<HalfEdge>& twins, HalfEdge first, const Visit& visit) {
  for (HalfEdge h = first; h >= 0 && visit(h); h = twins[previous_in_triangle(h)]) {
  }
  for (HalfEdge h = twins[first]; h >= 0 && visit(next_in_triangle(h)); h = twins[next_in_triangle(h)]) {
  }
}

}  // namespace

Fans find_fans(const SourceMesh& mesh, const std::vector<HalfEdge>& twins) {
  Fans fans;
  fans.of_corner.assign(twins.size(), -1);
  for (std::size_t i = 0; i < twins.size(); ++i) {
    if (fans.of_corner[i] >= 0) continue;
    const auto first = static_cast<HalfEdge>(i);
    const auto fan = static_cast<std::int32_t>(fans.vertices.size());
    fans.vertices.push_back(half_edge_start(mesh, first));
    // The other way around a closed circle finds nothing new.
    for_each_in_fan(twins, first, [&](HalfEdge h) {
      const bool is_new = fans.of_corner[h] < 0;
      if (is_new) fans.of_corner[h] = fan;
      return is_new;
    });
  }
  return fans;
}

std::size_t count_fan(const std::vector<HalfEdge>& twins, HalfEdge leaving) {
  std::size_t count = 0;
  bool is_closed = false;
  for_each_in_fan(twins, leaving, [&](HalfEdge h) {
    // Back where it began: then nothing is left for the other way, either.
    is_closed = is_closed || (count > 0 && h == leaving);
    if (!is_closed) ++count;
    return !is_closed;
  });
  return count;
}

}  // namespace lozenge
