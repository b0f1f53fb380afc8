// Resampling of the surface over the half-diamonds of its domain (paper, Sec. 4.2 and 6.0.1).
#pragma once

#include "formats/base/progress.h"
#include "formats/domain/parameterization.h"
#include "formats/patches/patch_set.h"
#include "formats/surface/source_mesh.h"

namespace lozenge {

struct SampleOptions {
  /// Samples a side of patches whose first level is 0, borders included: 2^k + 1, from 2 to kMostSamples. 0: the fewest
  /// that hold the source to `error` (`choose_samples`).
  std::int32_t samples = 0;
  /// Root mean square of the distance between the samples' mesh and the source, in percent of the diagonal of the
  /// source's bounding box.
  double error = kUsualError;
};

/// Largest N: 2^10 + 1.
inline constexpr std::int32_t kMostSamples = 1025;

/// How many a side the options lead to at most.
std::int32_t samples_at_most(const SampleOptions& options);

/// Samples of every patch of the map's domain: position and shading normal of the surface point whose image is the
/// sample's place. A place's source triangle is found exactly, on the lattice (formats/source_locator.h).
///
/// Along a boundary, samples inside a side of the domain slide into the source's corners beside them
/// (`boundary_corners.h`).
///
/// A sample that several patches share is computed once, by its owner, and copied: on the segment from a triangle's
/// corner to its barycentre by the patch whose edge starts in that corner; in a corner by the lowest patch. Samples of
/// different places differ in the bits of their positions, and so do not weld. Same bits on any number of threads.
/// \throws Error(kUsage) where N isn't 2^k + 1; Error(kUnusableInput) where the map is folded or leaves a place
/// uncovered; Error(kLimit) where there would be 2^31 samples or more
PatchSet sample(const SourceMesh& mesh, const Parameterization& map, const SampleOptions& options = {},
                const Progress& progress = {});

}  // namespace lozenge
