// Closed surfaces made by formulas, for the tests of this stage.
#pragma once

#include <functional>
#include <vector>

#include "formats/source_mesh.h"

namespace lozenge::test {

/// A grid on a torus of radii 1 and `tube`, moved along its normal by `relief(angle around, angle along the tube)`.
SourceMesh torus(int around, int along, double tube, const std::function<double(double, double)>& relief);

/// A sphere from an octahedron cut into n x n triangles a face, its radius 1 + relief(direction).
SourceMesh sphere(int n, const std::function<double(const Vec3d&)>& relief);

/// A smooth random relief of a few waves, below `height`; another one for every seed.
std::function<double(const Vec3d&)> random_relief(double height, unsigned seed);

/// Both surfaces, the second moved along x by `distance`.
SourceMesh beside(const SourceMesh& first, const SourceMesh& second, double distance);

}  // namespace lozenge::test
