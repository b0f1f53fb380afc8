// Baked maps as image files: PNG (8 or 16 bits) and OpenEXR, through OpenImageIO.
//
// Floating-point pixels hold a map's numbers as they are, integers as its kind says (map_kinds.h). Kind and layout
// travel in the file, in a text field (PNG) or attribute (EXR) named "Description": "lozenge tangent-normal columns=16
// rows=15 tile=128 gutter=4 shrink=1 level=0". No times, no paths: the same map gives the same bytes.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "formats/patches/baked_maps.h"

namespace lozenge {

/// \param path  ends in .png or .exr
/// \param bits  a channel: 8 or 16 in a PNG, 16 or 32 (floating point) in an EXR
/// \param normal_y  of tangent-space normals; the file says so, and who reads it here gets them with y up again
/// \throws Error(kUsage) for another ending or other bits, for a map that doesn't fit into the 0..1 of a PNG, and where
/// the file can't be written
void write_map(const std::filesystem::path& path, const BakedMap& map, int bits = 8, NormalY normal_y = NormalY::kUp);

/// The map that `read_map` would read from the file that `write_map` writes with so many bits: of a PNG, rounded to its
/// steps, and with its bytes. \throws Error(kUsage) as `write_map`
BakedMap as_stored(BakedMap map, bool is_png, int bits, NormalY normal_y = NormalY::kUp);

/// The bytes of the PNG that `write_map` writes, for embedding in another file.
std::vector<std::uint8_t> png_of(const BakedMap& map, int bits = 8, NormalY normal_y = NormalY::kUp);

/// The map, its values as near as the file's bits hold them. A map that was read and is written again with as many bits
/// gives the same bytes.
/// \throws Error(kUnusableInput) where the file isn't a picture, isn't one of our maps, or contradicts its own layout;
/// Error(kLimit) where it has more than kMostMapSize texels a side
BakedMap read_map(const std::filesystem::path& path);

}  // namespace lozenge
