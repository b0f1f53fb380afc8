// What a mesh of another program holds, before it is imported.
#pragma once

#include <filesystem>

#include "stages/info/info.h"

namespace lozenge {

/// Of an asset in a format that has but one mesh: triangles, vertices, attributes, materials.
/// \throws Error as open_input
FileInfo describe_input(const std::filesystem::path& path);

}  // namespace lozenge
