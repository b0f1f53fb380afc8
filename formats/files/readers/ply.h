// PLY: a header that lists elements and the types of their properties, then the values in that order.
#pragma once

#include <filesystem>

#include "formats/files/readers/input_asset.h"
#include "formats/files/readers/input_limits.h"
#include "formats/files/readers/input_start.h"

namespace lozenge {

/// Sure where the first line is "ply".
Likeness likeness_to_ply(const InputStart& start);

/// PLY as text and as bytes of either order: of the element `vertex` x y z, normals (nx ny nz), colours (red green blue
/// alpha, or r g b a, perhaps with diffuse_ before them; vertex_colors.h) and texture coordinates (s t, u v, texture_u
/// texture_v); of the element `face` the list vertex_indices or vertex_index, and the list texcoord (two for each
/// corner). All may be of any type; everything else is left out. \throws Error(kUnusableInput) naming the line, or the
/// byte, where header or data are broken
InputAsset read_ply(const std::filesystem::path& path, const InputLimits& limits);

}  // namespace lozenge
