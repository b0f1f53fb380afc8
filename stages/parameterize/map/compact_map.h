// A copy of a map to sweep over, in which what is near on the domain is near in memory.
//
// A source mesh numbers its vertices and triangles as it pleases, and a coarse level of a large one lies scattered over
// arrays a hundred times as long. Most of a sweep is waiting for memory then: half of the time on 832,000 triangles.
#pragma once

#include <vector>

#include "stages/parameterize/map/homes.h"
#include "stages/parameterize/map/working_map.h"

namespace lozenge {

/// The vertices that a map has at home somewhere and the triangles that are left, numbered without gaps along a curve
/// through each domain triangle. The copy keeps no lists of vertices and has no positions in space.
class CompactMap {
 public:
  explicit CompactMap(const WorkingMap& whole);

  WorkingMap& map() { return map_; }

  /// Puts the vertices of the whole where those of the copy are now, and pins those that are pinned there.
  void write_back(WorkingMap& whole) const;

 private:
  std::vector<VertexId> vertices_;     ///< [vertex of the copy] its number in the whole
  std::vector<TriangleId> triangles_;  ///< [triangle of the copy] the same; corners are in the same order
  WorkingMap map_;
};

/// Has `work(map)` done on such a copy where the map is so large that this pays, else on the map itself. The work may
/// move vertices, and cones to other vertices; it changes neither mesh nor domain, and has no lists where it has a
/// copy.
template <typename Work>
auto on_compact_copy(WorkingMap& map, Work&& work) {
  // Arrays longer than this are not near in any cache.
  constexpr std::size_t kLeastToCompact = 50'000;
  if (map.is_compact) return work(map);
  if (map.home.size() < kLeastToCompact) {
    if (!map.listed) list_homes(map);
    return work(map);
  }
  CompactMap compact(map);
  auto result = work(compact.map());
  compact.write_back(map);
  return result;
}

}  // namespace lozenge
