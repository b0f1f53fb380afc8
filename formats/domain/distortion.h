// How far a map is from an isometry, and whether it folds: the numbers that Lozenge reports and ranks by.
#pragma once

#include <cstdint>
#include <vector>

#include "formats/domain/parameterization.h"
#include "formats/surface/source_mesh.h"

namespace lozenge {

/// Over all source triangles t, A_t its area and B_t its image's as shares of their totals, s1 >= s2 the singular
/// values of the map from the domain to the surface. Triangles of zero area on the surface weigh nothing.
struct Distortion {
  double area = 0;                    ///< sum A_t ((A_t/B_t + B_t/A_t) / 2 - 1)
  double angle = 0;                   ///< sum A_t ((s1/s2 + s2/s1) / 2) - 1
  double aggregate = 0;               ///< ((1 + area)^3 (1 + angle))^(1/4) - 1: the paper's (4) with gamma = 3
  double l2_stretch = 1;              ///< sqrt(sum A_t (s1^2 + s2^2) / 2) sqrt(domain area / surface area)
  std::int64_t folded_triangles = 0;  ///< images of zero or negative area, or with none; counted exactly
  double area_sum_error = 0;          ///< |sum of image areas / domain area - 1|; summed exactly
};

Distortion measure_distortion(const SourceMesh& mesh, const Parameterization& map);

/// Singular values s1 >= s2 of the linear map that takes the plane triangle to the space triangle (both by their
/// corners). Zero-area plane triangles give infinity.
struct SingularValues {
  double s1 = 1;
  double s2 = 1;
};
SingularValues singular_values(const std::array<Vec2d, 3>& plane, const std::array<Vec3d, 3>& space);

}  // namespace lozenge
