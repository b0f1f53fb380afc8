// A source far finer than any level that is to be made of it is made coarser first, patch by patch, on all threads.
#pragma once

#include <cstdint>
#include <vector>

#include "formats/patches/charted_surface.h"
#include "formats/patches/leave_out_flat_vertices.h"

namespace lozenge {

/// About so many triangles of the surface, each patch with its share, and as many more as its borders have sides: they
/// stay as fine as they are.
/// Vertices keep their numbers; those that went have no triangle. What corners carry inside of patches is no longer
/// right, and what bends is of no group of its own.
/// \param charts, least_height  as of `Simplifier`
ChartedSurface thinned(const ChartedSurface& surface, const std::vector<ChartScale>& charts, double least_height,
                       std::int64_t triangles);

}  // namespace lozenge
