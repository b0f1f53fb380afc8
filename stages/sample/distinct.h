// Keeps samples apart that rounding made equal.
#pragma once

#include "formats/patches/patch_neighbours.h"
#include "formats/patches/patch_set.h"

namespace lozenge {

/// The name of a sample that the others are copies of: the lowest by patch, then row, then column.
PatchSample owner_of(const PatchNeighbours& neighbours, const PatchSample& sample);

/// Readers weld samples whose positions have equal bits, so samples of different places must differ. They may not where
/// the source has triangles without area, or coordinates so large that floats are coarser than the grid: the later
/// one (by its owner's place) is then moved by the smallest steps that make it differ.
/// \return the number of samples that were moved
std::int64_t make_distinct(PatchSet& set);

}  // namespace lozenge
