// A glTF asset as the importer takes it.
#pragma once

#include <filesystem>

#include "formats/files/readers/input_asset.h"
#include "formats/files/readers/input_limits.h"
#include "formats/files/readers/input_start.h"

namespace lozenge {

/// Sure for what begins with GLB's magic or as JSON.
Likeness likeness_to_gltf(const InputStart& start);

/// Whether that is the format that a file is read as.
bool is_gltf(const std::filesystem::path& path);

/// The meshes that the asset's default scene places (of all root nodes, where it has no scene). Meshes that it doesn't
/// place have no primitives. What a mesh file of Lozenge says of itself is taken from there.
/// \throws Error as open_gltf and scene_instances; Error(kUnusableInput) where a primitive has no positions
InputAsset read_gltf(const std::filesystem::path& path, const InputLimits& limits);

}  // namespace lozenge
