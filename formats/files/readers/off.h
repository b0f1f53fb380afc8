// Geomview's OFF: a keyword, the numbers of vertices, faces and edges, then a line for each vertex and each face.
#pragma once

#include <filesystem>

#include "formats/files/readers/input_asset.h"
#include "formats/files/readers/input_limits.h"
#include "formats/files/readers/input_start.h"

namespace lozenge {

/// Sure where the first word is OFF with prefixes; a file without a keyword, which OFF allows, must be named so.
Likeness likeness_to_off(const InputStart& start);

/// OFF as text, with any of the prefixes ST, C and N for texture coordinates, colours (vertex_colors.h) and normals of
/// vertices; what follows the corners of a face is left out.
/// \throws Error(kUnusableInput) naming the line where it isn't OFF, Error(kUnsupported) for binary OFF and for points
///         of other than three coordinates
InputAsset read_off(const std::filesystem::path& path, const InputLimits& limits);

}  // namespace lozenge
