#include "stages/parameterize/map/snapshot.h"

namespace lozenge {

Snapshot take_snapshot(const WorkingMap& map) {
  return {map.mesh, map.rest, map.surface_area, map.domain, map.domain_faces, map.corner_of, map.anchor, map.kept,
          map.home, map.at,   map.pin,          map.chart,  map.first_in,     map.next_in,   map.last_in};
}

void go_back(WorkingMap& map, const Snapshot& s) {
  map.mesh = s.mesh;
  map.rest = s.rest;
  map.surface_area = s.surface_area;
  map.domain = s.domain;
  map.domain_faces = s.domain_faces;
  map.corner_of = s.corner_of;
  map.anchor = s.anchor;
  map.kept = s.kept;
  map.home = s.home;
  map.at = s.at;
  map.pin = s.pin;
  map.chart = s.chart;
  map.first_in = s.first_in;
  map.next_in = s.next_in;
  map.last_in = s.last_in;
}

}  // namespace lozenge
