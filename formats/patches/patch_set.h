// The surface resampled: one square patch for each domain edge, over its half-diamond (paper, Sec. 4.2 and 6.0.1).
#pragma once

#include <cstdint>
#include <vector>

#include "formats/base/vector.h"
#include "formats/patches/patch_grids.h"
#include "formats/patches/patch_layout.h"
#include "formats/surface/attribute.h"

namespace lozenge {

/// One square grid of samples for every domain edge, in the order of `edges(domain)`; left is the lower side. Grids
/// come one after the other, row by row (`grids`). Samples on a border are the same bits in both patches. Where a patch
/// has no right side, samples with v < u hold zeros and source triangle -1.
struct PatchSet {
  PatchLayout layout;
  PatchGrids grids;  ///< those of the layout's level 0

  std::vector<Vec3f> positions;
  std::vector<Vec3f> normals;                ///< unit: the source's shading normals
  std::vector<TriangleId> source_triangles;  ///< the source triangle whose image holds the sample
  std::vector<Vec3f> source_weights;         ///< its barycentric weights there
  /// 1 where that triangle caps a hole that the importer filled, else 0; empty where no sample lies on a cap.
  std::vector<std::uint32_t> caps;
  /// Elements of `kInfluences`, one for each sample; empty where no body has a skin.
  std::vector<float> influences;

  std::int32_t size() const { return layout.size(); }
  std::size_t index(std::int32_t patch, std::int32_t i, std::int32_t j) const { return grids.index(patch, i, j); }
};

/// A set with zeros for samples.
PatchSet empty_patch_set(PatchLayout layout);

}  // namespace lozenge
