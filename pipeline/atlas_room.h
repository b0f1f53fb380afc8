// Whether the patches of a build will fit into its maps: known long before they are made.
#pragma once

#include <cstdint>
#include <string>

#include "formats/patches/patch_layout.h"
#include "formats/surface/surface_facts.h"
#include "pipeline/build.h"

namespace lozenge {

/// No map of the surface has fewer patches: a domain has a patch for each edge, one and a half for a triangle.
std::int32_t least_patches(const SurfaceFacts& surface, const ParameterizeOptions& options);

/// \param file  as the message names it
/// \throws Error(kLimit) where the maps that are asked for can't hold these patches, saying which --map-size could
void require_room_in_maps(const PatchLayout& patches, const BuildOptions& options, const std::string& file);
/// The same of so many patches of one scale: no others need less room.
void require_room_in_maps(std::int32_t patches, const BuildOptions& options, const std::string& file);

}  // namespace lozenge
