// How large maps shall be where nobody says.
#pragma once

#include <cstdint>

#include "formats/patches/patch_layout.h"
#include "formats/surface/source_mesh.h"
#include "stages/bake/bake.h"

namespace lozenge {

/// How many texels lie on the surface: of each triangle those of its finest texture; 0 where it has none.
double texels_of_textures(const SourceMesh& mesh);

/// The side of a square atlas of these patches whose texels lie as densely on the surface as those of the source's
/// textures: of each triangle those of its finest texture, over the whole area the mean. A power of two, from 256 to
/// 4096, and no smaller than tiles of `default_map_size` need; that one where the source has no textures.
std::int32_t map_size_for(const SourceMesh& mesh, const PatchLayout& patches);

/// The same options, with a size where they have none.
BakeOptions with_map_size(const BakeOptions& options, const SourceMesh& mesh, const PatchLayout& patches);

}  // namespace lozenge
