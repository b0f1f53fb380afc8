// The source level as the arrays that an engine uploads, one mesh for each connected part.
#pragma once

#include <vector>

#include "formats/domain/parameterization.h"
#include "formats/patches/baked_maps.h"
#include "formats/patches/patch_layout.h"
#include "stages/export/engine_mesh.h"
#include "stages/export/export.h"

namespace lozenge {

/// The source's own triangles, cut to the patches of the atlas (formats/patches/source_level.h): its normals, hard
/// edges kept, tangents of the atlas's texture coordinates. Vertices are shared where all of that agrees by bits. On
/// borders of patches and on hard edges, positions have equal bits; those of different places differ.
struct SourceParts {
  std::vector<std::int32_t> part_of_patch;  ///< [patch]
  std::vector<EngineMesh> parts;            ///< [part]
  std::vector<std::int64_t> cap_triangles;  ///< [part] left out with its caps
  std::int64_t triangle_count() const;
};

/// \param layout  of the atlas that texture coordinates are for
/// \throws Error(kUnusableInput) where the map isn't the one that the patches were sampled from
SourceParts source_parts(const SourceSurface& source, const PatchLayout& patches, const MapLayout& layout, Caps caps);

}  // namespace lozenge
