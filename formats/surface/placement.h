// Where something stands: affine maps as the nodes of a glTF have them.
#pragma once

#include <Imath/ImathMatrix.h>

#include <array>

#include "formats/base/vector.h"

namespace lozenge {

/// An affine map in the order of a glTF node's `matrix`: the images of the three axes, then that of the origin, each
/// followed by a 0, the last by a 1.
using Placement = std::array<double, 16>;

inline constexpr Placement kUnmoved = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

/// The same as a matrix for row vectors, and back: what isn't affine about the matrix is lost.
Imath::M44d matrix_of(const Placement& placement);
Placement placement_of(const Imath::M44d& matrix);

Vec3f placed(const Placement& placement, const Vec3f& position);
Vec3d placed(const Imath::M44d& matrix, const Vec3d& position);

/// Whether it mirrors: triangles turn over.
bool is_mirroring(const Placement& placement);

/// Whether a glTF node can have it: it is finite, affine, keeps volume from vanishing, and turns the axes as a whole (a
/// translation, a rotation and a scale, but no shear).
bool is_node_transform(const Placement& placement);

/// Whether it is finite, affine, and can be undone in floats: no direction shrinks to less than a ten thousandth of
/// what it does to others.
bool is_invertible(const Placement& placement);

/// A transform into the scene, counted from another origin there.
Imath::M44d counted_from(const Vec3d& origin, Imath::M44d transform);

}  // namespace lozenge
