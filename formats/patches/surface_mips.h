// The mips of a baked map, filtered on the surface.
//
// Engines make mips with box filters over the picture. Inside of a tile, its gutter too, that is the surface's filter,
// for gutters hold what lies across the border; so both sides of a border show the same. It isn't at the corners of
// patches, where as many patches meet as the domain has triangles there, and a square has room for four; nor where a
// texel covers more than a tile. Here look-ups at a corner give the same from every patch around it, and coarse texels
// are means of what patches hold, without the gutters.
#pragma once

#include <cstdint>
#include <vector>

#include "formats/patches/baked_maps.h"
#include "formats/patches/patch_layout.h"

namespace lozenge {

/// One of a map's mips: texels as those of BakedMap.
struct MipLevel {
  std::int32_t width = 0;
  std::int32_t height = 0;
  std::vector<float> texels;
};

/// How many levels there are down to one texel, the map itself counted.
std::int32_t mip_count(const BakedMap& map);

/// The map's mips from half its size down to one texel, sides rounded down. Directions are unit vectors again; colours
/// with alpha count as much as they cover. Texels that show nothing of any patch are the mean of all that does.
/// \pre  the map's tiles are those of the patches
std::vector<MipLevel> surface_mips(const BakedMap& map, const PatchLayout& patches);

}  // namespace lozenge
