// What an operation on the domain is about to change, so that it can be taken back.
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "stages/parameterize/map/working_map.h"

namespace lozenge {

/// Remembers parts of a map as they are when `keep_…` is first called for them. Source vertices come back with their
/// homes and pins, source triangles with their charts, domain triangles with their corners and neighbours.
class Checkpoint {
 public:
  explicit Checkpoint(WorkingMap& map) : map_(map), faces_(map.domain_faces) {}

  void keep_triangle(DomainTriangleId t) { triangles_.emplace_back(t, map_.domain.triangles[t]); }
  void keep_domain_vertex(DomainVertex v) { corners_.push_back({v, map_.corner_of[v], map_.anchor[v]}); }
  void keep_vertex(VertexId v) { vertices_.push_back({v, map_.home[v], map_.at[v], map_.pin[v]}); }
  void keep_charts(TriangleId t) {
    charts_.push_back({t, {map_.chart[3 * t], map_.chart[3 * t + 1], map_.chart[3 * t + 2]}});
  }

  /// Puts everything back.
  void restore();

 private:
  struct KeptCorner {
    DomainVertex vertex;
    DomainCorner corner;
    VertexId anchor;
  };
  struct KeptVertex {
    VertexId vertex;
    DomainTriangleId home;
    Vec2d at;
    DomainVertex pin;
  };
  struct KeptCharts {
    TriangleId triangle;
    std::array<UnitMotion, 3> charts;
  };
  WorkingMap& map_;
  std::int32_t faces_;
  std::vector<std::pair<DomainTriangleId, DomainTriangle>> triangles_;
  std::vector<KeptCorner> corners_;
  std::vector<KeptVertex> vertices_;
  std::vector<KeptCharts> charts_;
};

}  // namespace lozenge
