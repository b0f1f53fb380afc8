// What somebody else's glTF holds, before it is imported.
#pragma once

#include <filesystem>

#include "stages/info/info.h"

namespace lozenge {

/// Whether a glTF is the mesh that `import` wrote.
bool is_our_mesh(const std::filesystem::path& path);

/// Scene, generator, and what the scene places: nodes, primitives, triangles, vertices, materials, extensions.
FileInfo describe_gltf(const std::filesystem::path& path);

}  // namespace lozenge
