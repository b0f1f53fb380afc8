// The GLB of an asset: levels of detail that share one material.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "stages/export/engine_mesh.h"

namespace lozenge {

/// Encoded PNGs; empty where there is none.
struct AssetTextures {
  std::vector<std::uint8_t> normal;
  std::vector<std::uint8_t> occlusion;
};

/// What the file says about itself.
struct AssetOrigin {
  std::string scene_name;
  std::string source;  ///< name of the file that the surface came from
  std::int32_t patches = 0;
  std::int32_t samples = 0;        ///< a side, of the finest level in the file
  std::int32_t half_patches = 0;   ///< on the surface's boundary; said where there are any
  std::int64_t cap_triangles = 0;  ///< left out of all levels in the file; said where there are any
  bool double_sided = false;       ///< some of that surface is to be seen from both sides: so is all of the asset
};

/// Writes the levels, finest first, as one GLB: the scene shows the first, whose node names the others as its coarser
/// alternatives (extension MSFT_lod, with the screen coverages from which engines choose in `extras`).
/// \throws Error(kUsage) where the file can't be written
void write_asset(const std::filesystem::path& path, const std::vector<const EngineMesh*>& levels,
                 const AssetTextures& textures, const AssetOrigin& origin);

/// The smallest share of the screen at which each level, finest first, should still be shown: where the next coarser
/// one would have triangles of fewer than some pixels, it does as well. The last one is never hidden: 0.
std::vector<double> screen_coverages(const std::vector<const EngineMesh*>& levels);

}  // namespace lozenge
