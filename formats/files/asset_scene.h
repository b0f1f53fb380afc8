// How the scene of an exported asset places its parts: which nodes show which levels of detail, and where.
#pragma once

#include <Imath/ImathMatrix.h>

#include <cstdint>
#include <string>
#include <vector>

#include "formats/files/readers/gltf/model.h"
#include "formats/surface/bodies.h"

namespace lozenge {

/// In the extras of `asset`, where levels of detail are siblings whose names end in _LOD0, _LOD1, ...
inline constexpr const char* kLodsAsNodes = "lods_as_nodes";

/// The nodes of a part, which is a mesh of the scene with its coarser levels of detail.
struct AssetNodes {
  std::vector<int> levels;          ///< the first that places it, then those of the coarser levels
  Body body;                        ///< from the mesh to the scene, at rest; the morph targets of the finest level
  std::vector<Imath::M44d> joints;  ///< of each joint to the scene, where a skin places it; else empty
};

struct AssetScene {
  std::vector<AssetNodes> parts;  ///< in the order in which the scene places them first
  Rig rig;
};

/// \throws Error as `read_asset`
AssetScene read_asset_scene(const GltfFile& file);

/// A number that `export` writes into the extras of `asset`; 0 where it isn't there.
std::int32_t asset_number(const GltfFile& file, const std::string& key);
/// The same of a list of such numbers; empty where there is none.
std::vector<std::int32_t> asset_numbers(const GltfFile& file, const std::string& key);

}  // namespace lozenge
