// How far a map is from an isometry, and whether it folds: the numbers that Lozenge reports and ranks by.
#pragma once

#include <cstdint>
#include <vector>

#include "formats/domain/parameterization.h"
#include "formats/surface/source_mesh.h"

namespace lozenge {

/// Over all source triangles t, A_t its area and B_t its image's as shares of their totals, s1 >= s2 the singular
/// values of the map from the domain to the surface. The domain's triangles are scaled by 2^-k, k their first level.
/// Triangles of zero area on the surface weigh nothing.
struct Distortion {
  double area = 0;                    ///< sum A_t ((A_t/B_t + B_t/A_t) / 2 - 1)
  double angle = 0;                   ///< sum A_t ((s1/s2 + s2/s1) / 2) - 1
  double aggregate = 0;               ///< `aggregate_of` both: what we rank by
  double l2_stretch = 1;              ///< sqrt(sum A_t (s1^2 + s2^2) / 2) sqrt(domain area / surface area)
  std::int64_t folded_triangles = 0;  ///< images of zero or negative area, or with none; counted exactly
  double area_sum_error = 0;          ///< |sum of image areas / domain area - 1|; summed exactly
};

/// How much more keeping areas weighs than keeping angles: gamma of the paper's (4), and its choice.
inline constexpr int kAreaWeight = 3;

/// Both distortions as one number, 0 for an isometry: the paper's (4), d_a^gamma d_c with gamma = 3, as a mean of its
/// four factors, less 1: (d_a^3 d_c)^(1/4) - 1.
/// \param d_a, d_c  distortion of areas and of angles, both 1 for an isometry: 1 + Distortion::area, 1 + ::angle
double aggregate_of(double d_a, double d_c);

/// What the best size of the domain has least of: the paper's (6), the aggregate times sqrt(|D|), |D| the number of
/// domain triangles.
double weighed_by_size(double aggregate, double domain_triangles);

Distortion measure_distortion(const SourceMesh& mesh, const Parameterization& map);

/// Singular values s1 >= s2 of the linear map that takes the plane triangle to the space triangle (both by their
/// corners). Zero-area plane triangles give infinity.
struct SingularValues {
  double s1 = 1;
  double s2 = 1;
};
SingularValues singular_values(const std::array<Vec2d, 3>& plane, const std::array<Vec3d, 3>& space);

}  // namespace lozenge
