// Parameterized spheres whose map is known exactly: for tests of whatever needs a Parameterization.
#pragma once

#include <functional>
#include <utility>
#include <vector>

#include "formats/domain/parameterization.h"

namespace lozenge::fixtures {

Domain tetrahedron();
Domain octahedron();
Domain icosahedron();

/// Every triangle of the domain cut into n x n triangles, lifted to the unit sphere; the map is the subdivision's own.
/// \pre `base` is one of the three above
std::pair<SourceMesh, Parameterization> subdivided_sphere(const Domain& base, int n);

/// The same of any domain: `corners` are the places of its vertices, and `lift` takes n times a point of a flat
/// triangle to the surface. Names stay empty.
std::pair<SourceMesh, Parameterization> subdivided(const Domain& base, int n, const std::vector<Vec3d>& corners,
                                                   const std::function<Vec3d(const Vec3d&)>& lift);

/// Moves every position that lies strictly inside a domain triangle by up to `distance` (of a side) in a random
/// direction, as far as it stays inside. Below a third of the spacing of the grid nothing folds.
void jitter(Parameterization& map, double distance, unsigned seed);

}  // namespace lozenge::fixtures
