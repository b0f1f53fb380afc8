// Where the samples of a geometry image lie on the surface that it was sampled from: what vertices carry in file
// formats that the image has no room for is found there.
#pragma once

#include <vector>

#include "formats/domain/source_locator.h"
#include "formats/patches/geometry_image.h"
#include "stages/export/export.h"

namespace lozenge {

/// [sample of level 0, as in its `PatchGrids`] of the patches of bodies that have morph targets; triangle -1 of all
/// others, and beyond the boundary. Nothing where no body has any.
/// \throws Error(kUnusableInput) where the map is broken
std::vector<SourcePoint> sample_origins(const GeometryImage& image, const SourceSurface& source);

}  // namespace lozenge
