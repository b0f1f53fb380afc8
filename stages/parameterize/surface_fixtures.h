// Surfaces made by formulas, for the tests of this stage.
#pragma once

#include <functional>
#include <vector>

#include "formats/surface/source_mesh.h"

namespace lozenge::test {

/// A grid on a torus of radii 1 and `tube`, moved along its normal by `relief(angle around, angle along the tube)`.
SourceMesh torus(int around, int along, double tube, const std::function<double(double, double)>& relief);

/// A sphere from an octahedron cut into n x n triangles a face, its radius 1 + relief(direction).
SourceMesh sphere(int n, const std::function<double(const Vec3d&)>& relief);

/// A smooth random relief of a few waves, below `height`; another one for every seed.
std::function<double(const Vec3d&)> random_relief(double height, unsigned seed);

/// A square of n x n cells, each of two triangles, in the xy plane and moved along z by relief(point).
SourceMesh sheet(int n, const std::function<double(const Vec3d&)>& relief);

/// A band of so many cells around a cylinder of radius 1 and so many along its axis, `width` wide.
SourceMesh band(int around, int along, double width);

/// The surface without so many balls about some of its vertices, and of what is left the largest piece; ragged where it
/// ends, and oriented and manifold. Another one for every seed.
SourceMesh opened(const SourceMesh& mesh, int holes, double radius, unsigned seed);

/// Both surfaces, the second moved along x by `distance`.
SourceMesh beside(const SourceMesh& first, const SourceMesh& second, double distance);

}  // namespace lozenge::test
