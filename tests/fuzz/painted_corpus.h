// The pictures that fuzzing starts from, and assets whose materials have them.
#pragma once

#include <filesystem>

namespace lozenge::fuzz {

/// Pictures of each format into `root`/texture, painted assets into `root`/import and `root`/source_mesh.
/// \pre  these folders are there
void write_painted_corpus(const std::filesystem::path& root);

}  // namespace lozenge::fuzz
