// STL: triangles without anything shared between them, as text or as bytes.
#pragma once

#include <filesystem>

#include "formats/files/readers/input_asset.h"
#include "formats/files/readers/input_limits.h"
#include "formats/files/readers/input_start.h"

namespace lozenge {

/// Sure where the file is as long as its number of triangles says, or begins with "solid"; anything else may be a
/// damaged one.
Likeness likeness_to_stl(const InputStart& start);

/// The three corners of each triangle are vertices of their own, which the importer welds. Normals, which are those of
/// the triangles, names and the two bytes that some programs put a colour into are left out.
/// \throws Error(kUnusableInput) naming the line, or the byte, where it is neither text nor bytes of STL, or breaks off
InputAsset read_stl(const std::filesystem::path& path, const InputLimits& limits);

}  // namespace lozenge
