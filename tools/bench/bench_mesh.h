// Meshes to measure with, made from others or from a formula; the same bits at every run.
#pragma once

#include <cstdint>

#include "tools/surface_file.h"

namespace lozenge::bench {

/// The unit sphere: an icosahedron whose faces are cut into n^2 triangles each, n so that there are about `triangles`.
Surface sphere_mesh(std::int32_t triangles);

/// A ring around the z axis, of radius 1 and 0.4, of about so many triangles.
Surface torus_mesh(std::int32_t triangles);

/// What becomes four times as large with the surface staying what it is: every triangle is cut in four at the midpoints
/// of its edges, and each midpoint moves along its normal by up to `noise` of the mean edge length then, but by no more
/// than a quarter of the height of a triangle beside it. So finer levels have finer relief.
/// \param mesh  welded
/// \throws Error(kUnusableInput) where triangles without area or equal positions would come out
Surface subdivided(const Surface& mesh, int times, double noise, std::uint64_t seed);

struct UnevenOptions {
  double removed = 0.6;      ///< share of the vertices to remove
  double flips = 3.0;        ///< tried for each collapse that was tried
  double tolerance = 0.008;  ///< most that the surface may move, of the diagonal of its box
  double most_turn = 70;     ///< most that a triangle's normal may turn, degrees
};

/// The same closed surface in uneven, thin triangles, as in the paper's Fig. 10: random vertices are collapsed into a
/// neighbour, and random edges flipped, as far as the surface stays what it is.
/// \param mesh  welded
/// \throws Error(kUnsupported) where it isn't closed, oriented and 2-manifold
Surface uneven(const Surface& mesh, std::uint64_t seed, const UnevenOptions& options = {});

}  // namespace lozenge::bench
