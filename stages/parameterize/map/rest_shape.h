// What the energy needs to know of a source triangle: its shape, up to where it lies in space.
//
// The shape of a needle is a form with two very different eigenvalues, their ratio the square of its flatness. Single
// precision loses the small one below about 1/4000, and the energy could turn negative; long before, a needle that lies
// a little wrong has an energy that outweighs the whole surface, and sweeps take forever to get over it. So flat
// triangles are taken to be higher than they are, by as much as their part in the surface allows.
#pragma once

#include <array>
#include <vector>

#include "formats/surface/source_mesh.h"

namespace lozenge {

/// Squared lengths and areas by which the energy measures a triangle's image: T = sum of weight[i] * |image of the side
/// opposite corner i|^2, and d = (doubled image area) * inverse_area, both before the scale of the whole surface is
/// applied.
struct RestShape {
  std::array<float, 3> weight{};
  float inverse_area = 0;  ///< of the doubled area
  float share = 0;         ///< of the whole surface's area
};

/// The flattest triangle, height by longest side, that single precision holds well.
inline constexpr double kFlattest = 1e-3;

/// \param flattest  a triangle that is flatter gets this height above its longest side; its share stays what it is
RestShape rest_shape(const std::vector<Vec3f>& positions, const std::array<VertexId, 3>& triangle, double surface_area,
                     double flattest);

/// The largest `flattest`, up to a hundredth, that changes the shapes of no more than a hundredth of the surface; at
/// least kFlattest.
double flattest_to_keep(const std::vector<Vec3f>& positions, const std::vector<std::array<VertexId, 3>>& triangles);

}  // namespace lozenge
