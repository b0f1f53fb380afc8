// Wavefront OBJ: one statement a line, whose first word says what it is.
#pragma once

#include <filesystem>

#include "formats/files/readers/input_asset.h"
#include "formats/files/readers/input_limits.h"
#include "formats/files/readers/input_start.h"

namespace lozenge {

/// Sure where each of its first lines begins with a statement of OBJ.
Likeness likeness_to_obj(const InputStart& start);

/// OBJ: v with or without a colour (x y z r g b; vertex_colors.h), vt, vn, f with negative indices too, usemtl. Each
/// usemtl is a material by its name, and looks as the files say that mtllib names (mtl.h). Groups and objects (g, o)
/// say what belongs together, not what it looks like, and are joined; curves and free-form surfaces are left out.
/// \throws Error(kUnusableInput) naming the line
InputAsset read_obj(const std::filesystem::path& path, const InputLimits& limits);

}  // namespace lozenge
