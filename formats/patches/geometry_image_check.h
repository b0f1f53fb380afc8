// What a sound geometry image is, beyond its layout: the promises that its samples keep.
#pragma once

#include <optional>
#include <string>

#include "formats/patches/geometry_image.h"

namespace lozenge {

/// What breaks the promises of the samples, in words that name the place, or nothing: all are finite and inside the
/// bounds; normals are unit vectors; both patches along a border hold the same bits; tiles without a patch and halves
/// beyond the surface's boundary hold zeros; each level is every second sample of the finer one.
/// \pre the layout is sound: places, adjacency and the sizes of the arrays fit each other
std::optional<std::string> find_defect(const GeometryImage& image);

}  // namespace lozenge
