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
using Vec4d = Imath::V4d;

/// -0 becomes +0: the form in which files hold vectors, so that equal numbers are equal bits.
inline Vec3f without_negative_zeros(const Vec3f& v) { return {v.x + 0.0F, v.y + 0.0F, v.z + 0.0F}; }

/// Index of a welded vertex of a source mesh.
using VertexId = std::int32_t;
/// Index of a triangle of a source mesh.
using TriangleId = std::int32_t;

}  // namespace lozenge
