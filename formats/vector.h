// Points and vectors. Imath is the vector library of OpenEXR: small headers, plain data, well kept.
#pragma once

#include <Imath/ImathVec.h>

#include <cstdint>

namespace lozenge {

using Vec2f = Imath::V2f;
using Vec2d = Imath::V2d;
using Vec3f = Imath::V3f;
using Vec3d = Imath::V3d;
using Vec4f = Imath::V4f;

/// Index of a welded vertex of a source mesh.
using VertexId = std::int32_t;
/// Index of a triangle of a source mesh.
using TriangleId = std::int32_t;

}  // namespace lozenge
