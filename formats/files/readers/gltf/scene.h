// The meshes that a glTF scene places, with the transform of each (glTF 2.0 specification, Sec. 3.5).
#pragma once

#include <string>
#include <vector>

#include "formats/files/readers/gltf/model.h"
#include "formats/files/readers/input_asset.h"

namespace lozenge {

/// Of the default scene; of the first one where none is the default; of all root nodes where there is no scene. Depth
/// first, children in their order. Doesn't recurse. A node with EXT_mesh_gpu_instancing places its mesh once for each
/// of its instances, in their order. \throws Error(kUnusableInput) where a node is reached twice or its transform isn't
/// affine, Error(kLimit) where there
///         are more than a million instances
std::vector<InputInstance> scene_instances(const GltfFile& file);

/// The nodes at the top of that scene.
std::vector<int> scene_roots(const GltfFile& file);

/// The name of that scene; where it has none, of the only mesh or node; else the file's stem.
std::string scene_name(const GltfFile& file);

}  // namespace lozenge
