// The files that fuzzing the readers of PLY, OBJ, STL and OFF starts from.
#pragma once

#include <filesystem>

namespace lozenge::fuzz {

/// A folder for each format, with small files that hold all that its reader looks at.
void write_mesh_corpus(const std::filesystem::path& root);

}  // namespace lozenge::fuzz
