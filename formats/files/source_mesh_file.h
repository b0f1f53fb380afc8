// SourceMesh <-> GLB: a plain glTF that any viewer opens, and that gives back the same mesh bit by bit.
//
// One node, one mesh, one primitive for each material. A vertex of the file is a welded vertex with one set of
// attributes, so it is split only as far as attributes differ. What glTF has no place for is in `asset.extras.lozenge`.
#pragma once

#include <filesystem>

#include "formats/surface/source_mesh.h"

namespace lozenge {

/// \pre `mesh` is canonical and has a triangle
/// \throws Error(kUsage) where the file can't be written, Error(kLimit) where it would pass the 4 GB of a GLB
void write_source_mesh(const std::filesystem::path& path, const SourceMesh& mesh);

/// The mesh that `write_source_mesh` was given.
/// \throws Error(kUnusableInput) where the file is broken, isn't one of these, or was changed since
SourceMesh read_source_mesh(const std::filesystem::path& path);

/// Whether a file says that `write_source_mesh` wrote it; false of any that can't be read.
bool is_source_mesh_file(const std::filesystem::path& path);

}  // namespace lozenge
