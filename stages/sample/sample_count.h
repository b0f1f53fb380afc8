// How many samples a surface needs.
#pragma once

#include <cstdint>

#include "formats/base/progress.h"
#include "stages/sample/surface_samples.h"

namespace lozenge {

struct SampleChoice {
  std::int32_t samples = 2;  ///< a side
  double deviation = 0;      ///< root mean square of the distance to the source, percent of its box's diagonal
};

/// The most samples a side that are chosen.
inline constexpr std::int32_t kMostChosenSamples = 65;

/// The fewest samples a side, 2^k + 1, whose mesh lies no farther from the source than `error` percent of the diagonal
/// (root mean square); or the most that are worth it: kMostChosenSamples, or as many as give
/// `worthwhile_triangles`.
///
/// Measured at the samples of a grid of four times (at least twice) as many steps, each against the triangle of the
/// coarse grid that holds its place: no less than the distance to the mesh, and nearly as small.
/// \throws Error(kUsage) where `error` is no number from 0 up, Error(kUnusableInput) as `sample`
SampleChoice choose_samples(const PatchSampler& sampler, double error, const Progress& progress);

}  // namespace lozenge
