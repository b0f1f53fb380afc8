// The energy of a map: each triangle's (paper, eq. 4) by its share of the surface.
#pragma once

#include <vector>

#include "stages/parameterize/map/working_map.h"

namespace lozenge {

/// Share of the surface times f(T, d); infinite where the image is folded.
/// \param scale  of the map, or of another size of its domain (`WorkingMap::scale_with`)
double triangle_energy(const WorkingMap& map, TriangleId t, double scale);
inline double triangle_energy(const WorkingMap& map, TriangleId t) { return triangle_energy(map, t, map.scale()); }
double total_energy(const WorkingMap& map);
/// Sum of the energies of the triangles.
double energy_of(const WorkingMap& map, const std::vector<TriangleId>& triangles, double scale);
inline double energy_of(const WorkingMap& map, const std::vector<TriangleId>& triangles) {
  return energy_of(map, triangles, map.scale());
}

}  // namespace lozenge
