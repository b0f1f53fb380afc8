// A surface over an atlas of its own.
#pragma once

#include <string>
#include <vector>

#include "formats/patches/charted_surface.h"
#include "formats/patches/strip_layout.h"
#include "pipeline/unwrap/unwrap.h"

namespace lozenge {

struct UnwrappedSurface {
  ChartedSurface surface;  ///< groups are origins, and what corners carry are weights in them
  StripLayout layout;      ///< charts are strips
  UnwrapAtlas atlas;
};

/// Maps a surface with origins, and cuts it to the patches of an atlas.
/// \param name  of the atlas, for messages
/// \throws Error as `parameterize`; Error(kLimit) where the atlas that is asked for is too small
UnwrappedSurface unwrap_surface(SourceMesh surface, const std::string& name, const UnwrapOptions& options,
                                const Progress& progress, std::vector<std::string>& notes);

}  // namespace lozenge
