// A plain triangle mesh, sampled regularly over the interpolation domains of any partition of D (paper, Sec. 6.0.1).
#pragma once

#include <cstdint>

#include "formats/base/progress.h"
#include "formats/domain/parameterization.h"
#include "formats/domain/partition.h"
#include "formats/surface/source_mesh.h"

namespace lozenge {

struct RemeshOptions {
  Partition partition = Partition::kHalfDiamonds;
  /// Steps along a side of each cell, 1 to kMostRate: a face has rate^2 triangles, a half-diamond 2 rate^2, each slice
  /// of a half-star (between its centre and two neighbouring barycentres) rate^2.
  std::int32_t rate = 16;
};

inline constexpr std::int32_t kMostRate = 1024;

/// The surface resampled as a plain mesh, watertight wherever the domain is: vertices that cells share are one vertex.
/// Positions alone; names come from `mesh`.
///
/// Half-stars and half-diamonds place the same grid: the short diagonal of a half-diamond is the border between the
/// half-stars of its ends, so the k slices around a vertex are k halves of half-diamonds. Their triangles come in
/// another order. Where the surface ends, half-diamonds and slices are cut along the domain edge. \throws Error as
/// `sample` does
SourceMesh remesh(const SourceMesh& mesh, const Parameterization& map, const RemeshOptions& options = {},
                  const Progress& progress = {});

}  // namespace lozenge
