// How the scene of an exported asset places its parts: which nodes show which levels of detail, and where.
#pragma once

#include <Imath/ImathMatrix.h>

#include <cstdint>
#include <string>
#include <vector>

#include "formats/files/readers/gltf/model.h"
#include "formats/surface/bodies.h"

namespace lozenge {

/// The nodes of a part, which is a mesh of the scene with its coarser levels of detail.
struct AssetNodes {
  std::vector<int> levels;          ///< the first that places it, then those that its MSFT_lod names
  std::vector<Placement> places;    ///< from the mesh to the scene, at rest
  std::vector<Imath::M44d> joints;  ///< the same, of each joint, where a skin places it; else empty
};

/// In the order in which the scene places them first.
/// \throws Error as `read_asset`
std::vector<AssetNodes> find_asset_parts(const GltfFile& file);

/// A number that `export` writes into the extras of `asset`; 0 where it isn't there.
std::int32_t asset_number(const GltfFile& file, const std::string& key);
/// The same of a list of such numbers; empty where there is none.
std::vector<std::int32_t> asset_numbers(const GltfFile& file, const std::string& key);

}  // namespace lozenge
