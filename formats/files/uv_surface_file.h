// The texture coordinates of an asset's first mesh, to be measured.
#pragma once

#include <filesystem>

#include "formats/surface/uv_statistics.h"

namespace lozenge {

/// All primitives of the first mesh that the asset places, in its own space.
/// \throws Error as `open_input`; Error(kUnusableInput) where a primitive has no texture coordinates of this set
UvSurface read_uv_surface(const std::filesystem::path& path, int set = 0);

}  // namespace lozenge
