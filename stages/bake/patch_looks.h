// What patches look like from so far away that hardly more than their colours are left.
#pragma once

#include <vector>

#include "formats/patches/mosaic.h"
#include "stages/bake/projector.h"
#include "stages/bake/source_look.h"

namespace lozenge {

/// [patch] of each cell: base colour, multiplied by alpha (3 numbers); alpha, occlusion, roughness, metal, and how much
/// it glows. Colours are about as far apart as one sees them. What lies beyond the surface's boundary is mirrored
/// in it, as it is in maps.
std::vector<PatchLook> looks_of_patches(const PatchLayout& patches, const Projector& projector, const SourceLook& look);

}  // namespace lozenge
