// Which point of the source every texel of an atlas shows, by the parameterization: for those who fill maps themselves.
#pragma once

#include <vector>

#include "formats/base/progress.h"
#include "formats/domain/source_locator.h"
#include "formats/patches/geometry_image.h"
#include "formats/patches/map_layout.h"

namespace lozenge {

/// [texel of the layout, row by row from the top] its source point; triangle -1 where no tile lies. Texels of gutters
/// show what lies across the border, so a map that is filled by this needs nothing more. \throws Error(kUnusableInput)
/// where the map is folded, or leaves a place uncovered; Error(kUsage) where the image is of another map
std::vector<SourcePoint> texel_sources(const SourceMesh& mesh, const Parameterization& map, const GeometryImage& image,
                                       const MapLayout& layout, const Progress& progress = {});

}  // namespace lozenge
