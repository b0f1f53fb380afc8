// Proves the guarantees of every file that Lozenge writes, one named line each, and says which one breaks where. What
// is proved of each of them is in check_source_mesh.h, check_parameterization.h, ...
#pragma once

#include <filesystem>

#include "stages/check/check_report.h"

namespace lozenge {

/// Recognises the file by its content, reads it and checks all that can be proved of it. A geometry image is also
/// compared with the JSON beside it, a map with the geometry image of its name. \throws Error(kUnusableInput) where the file cannot be opened or is none of
/// Lozenge's kinds
CheckReport check_file(const std::filesystem::path& path);

}  // namespace lozenge
