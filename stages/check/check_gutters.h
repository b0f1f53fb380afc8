// What maps promise of the atlas: gutters show what lies across the borders of patches, and mips mix no two of them.
#pragma once

#include "formats/files/map_mips_file.h"
#include "formats/patches/geometry_image.h"
#include "stages/check/check_report.h"

namespace lozenge {

/// No gutter texel differs from its owner's, the texel of the patch that it continues into; directions in the frames of
/// patches mean the same, within what so many bits (32: float) hold of both. In maps of less than the atlas's
/// resolution gutters lie between their owners' texels, and are what a look-up there gives. Nothing is added for maps
/// in the frames of the source's own triangles, which only the source knows.
void check_gutters(const BakedMap& map, int bits, const GeometryImage& image, CheckReport& report);

/// Mips are what filtering the map on the surface gives, to a step of their bits.
void check_mips(const MapMips& maps, const GeometryImage& image, CheckReport& report);

}  // namespace lozenge
