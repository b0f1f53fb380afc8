// A whole map, kept to go back to it (paper, Sec. 5.8).
#pragma once

#include <vector>

#include "stages/parameterize/map/working_map.h"

namespace lozenge {

/// All of a WorkingMap that operations change. Small: proxies have some thousand triangles.
struct Snapshot {
  HalfedgeMesh mesh;
  std::vector<RestShape> rest;
  double surface_area = 0;
  Domain domain;
  std::int32_t domain_faces = 0;
  std::vector<DomainCorner> corner_of;
  std::vector<VertexId> anchor;
  std::vector<char> kept;
  std::vector<DomainTriangleId> home;
  std::vector<Vec2d> at;
  std::vector<DomainVertex> pin;
  std::vector<UnitMotion> chart;
  std::vector<VertexId> first_in, next_in, last_in;
};

Snapshot take_snapshot(const WorkingMap& map);
void go_back(WorkingMap& map, const Snapshot& snapshot);

}  // namespace lozenge
