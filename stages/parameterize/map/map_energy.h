// The energy of a map: each triangle's (paper, eq. 4) by its share of the surface.
#pragma once

#include <vector>

#include "stages/parameterize/map/working_map.h"

namespace lozenge {

/// Share of the surface times f(T, d); infinite where the image is folded.
double triangle_energy(const WorkingMap& map, TriangleId t);
double total_energy(const WorkingMap& map);
/// Sum of the energies of all triangles with a corner among `vertices`, each once.
double energy_around(const WorkingMap& map, const std::vector<VertexId>& vertices);
/// Sum of the energies of the triangles.
double energy_of(const WorkingMap& map, const std::vector<TriangleId>& triangles);

}  // namespace lozenge
