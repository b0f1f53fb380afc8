// Whether all levels of detail of an asset show one atlas.
#pragma once

#include "formats/files/asset_file.h"
#include "stages/check/check_report.h"

namespace lozenge {

/// Each level is drawn with the textures of the finest, or with its own of the same atlas: for the same slots of the
/// material, and smaller by a power of two. Normals are told in frames, of which each level has its own: of those there
/// may be others, or none.
void check_level_textures(const Asset& asset, CheckReport& report);

}  // namespace lozenge
