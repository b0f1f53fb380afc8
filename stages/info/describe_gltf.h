// What somebody else's glTF holds, before it is imported.
#pragma once

#include <filesystem>
#include <string>

#include "stages/info/info.h"

namespace lozenge {

/// Scene, generator, what the scene places (nodes, primitives, triangles, vertices), materials, images, animations,
/// skins, extensions. \param changed  why it is not taken for what Lozenge wrote, though it says so; else empty
FileInfo describe_gltf(const std::filesystem::path& path, const std::string& changed = {});

}  // namespace lozenge
