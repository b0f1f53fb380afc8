// Meshes in and out of files, whatever the format.
#pragma once

#include <filesystem>

#include "tools/surface_file.h"

namespace lozenge::bench {

/// The mesh in a PLY, OBJ, STL or OFF as it is there, neither welded nor repaired; of a glTF or a geometry image, its
/// surface. \throws Error(kUnusableInput) where the file is missing or broken, of another kind, or has no triangle
Surface read_mesh(const std::filesystem::path& path);

/// As a GLB of one mesh with one primitive (positions and 32-bit indices), or as an ASCII OFF that gives the same
/// floats back. \throws Error(kUsage) where the name ends in neither .glb nor .off, or the file can't be written
void write_mesh(const std::filesystem::path& path, const Surface& mesh);

/// The same surface with vertices of equal position made one, those that no triangle uses left out, and so the
/// triangles that have two equal corners then.
Surface welded(const Surface& mesh);

}  // namespace lozenge::bench
