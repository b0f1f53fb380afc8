// Baked maps as image files: PNG (8 or 16 bits) and OpenEXR, through OpenImageIO.
//
// All are linear. Integer pixels hold normals halved and shifted, (n + 1) / 2, as glTF's normal maps do (y up in the
// picture: the OpenGL convention), and occlusion as it is. Kind and layout travel in the file, in a text field (PNG) or
// attribute (EXR) named "Description": "lozenge tangent-normal columns=16 rows=15 tile=128 gutter=4 shrink=1 level=0".
// No times, no paths: the same map gives the same bytes.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "formats/patches/baked_maps.h"

namespace lozenge {

/// "tangent-normal", "object-normal", "occlusion", "position".
std::string name_of(MapKind kind);

/// \param path  ends in .png or .exr
/// \param bits  a channel: 8 or 16 in a PNG, 16 or 32 (floating point) in an EXR
/// \throws Error(kUsage) for another ending or other bits, for positions in a PNG (they don't fit in 0..1), and where
/// the file can't be written
void write_map(const std::filesystem::path& path, const BakedMap& map, int bits = 8);

/// The bytes of the PNG that `write_map` writes, for embedding in another file.
std::vector<std::uint8_t> png_of(const BakedMap& map, int bits = 8);

/// The map, its values as near as the file's bits hold them. A map that was read and is written again with as many bits
/// gives the same bytes.
/// \throws Error(kUnusableInput) where the file isn't a picture, isn't one of our maps, or contradicts its own layout;
/// Error(kLimit) where it has more than kMostMapSize texels a side
BakedMap read_map(const std::filesystem::path& path);

}  // namespace lozenge
