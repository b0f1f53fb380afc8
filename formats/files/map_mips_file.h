// Baked maps with their mips, as KTX 2.0 files.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "formats/patches/baked_maps.h"
#include "formats/patches/surface_mips.h"

namespace lozenge {

/// A map and its mips, as a file holds them.
struct MapMips {
  BakedMap map;
  int bits = 8;                ///< a channel
  std::vector<MipLevel> mips;  ///< from half its size down to one texel
};

/// Colours as sRGB, all else linear; maps of two channels and more have four, the last one 1 where the map has none.
/// \param bits  a channel: 8 or 16. \pre  the map fits integers
/// \throws Error(kUsage) for other bits, and where the file can't be written
void write_map_mips(const std::filesystem::path& path, const BakedMap& map, const std::vector<MipLevel>& mips,
                    int bits);

/// \throws Error as `read_ktx2`, and Error(kUnusableInput) where its description tells of no baked map that fits it
MapMips read_map_mips(const std::filesystem::path& path);

}  // namespace lozenge
