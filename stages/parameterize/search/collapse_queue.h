// The edges of a shrinking domain, the cheapest collapse first (paper, Sec. 5.3).
#pragma once

#include <cstdint>
#include <optional>
#include <queue>
#include <vector>

#include "stages/parameterize/map/path_lengths.h"
#include "stages/parameterize/map/working_map.h"

namespace lozenge {

/// A heap of collapses by their cost (2). An entry is stale when its edge has been given another cost since.
class CollapseQueue {
 public:
  void rebuild(const WorkingMap& map, const SurfaceMeasures& measures);

  /// Gives the side's edge the cost that it has now.
  void push(const WorkingMap& map, const SurfaceMeasures& measures, DomainSide side);

  /// The same for every edge of the star of `n`, rim included.
  void update_star(const WorkingMap& map, const SurfaceMeasures& measures, DomainVertex n);

  /// The cheapest edge, which leaves the queue; nothing where it is empty.
  std::optional<DomainSide> pop(const WorkingMap& map);

 private:
  struct Entry {
    double cost;
    std::int32_t edge;
    std::int32_t version;
    bool operator<(const Entry& other) const { return cost != other.cost ? cost > other.cost : edge > other.edge; }
  };
  std::priority_queue<Entry> entries_;
  std::vector<std::int32_t> version_;  ///< [edge number]
};

}  // namespace lozenge
