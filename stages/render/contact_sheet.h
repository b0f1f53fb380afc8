// Pictures with captions on one sheet, and the sheet that shows what became of an asset.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "stages/render/render.h"
#include "stages/render/source_studio.h"

namespace lozenge {

/// Pictures of one size with a caption under each, `columns` side by side, under a title.
Picture contact_sheet(const std::vector<std::pair<std::string, Picture>>& pictures, std::int32_t columns,
                      const std::string& title);

/// The contact sheet that `build` leaves as NAME.preview.png: the source, its domain triangles, the distortion; and of
/// the asset as it ships the finest level whose triangles can be told apart: its edges, it with its maps, and the next
/// coarser one with its own. \param colour  of the source; clay without it \param more  pictures with captions after
/// those \param source_triangles  before edges of `mesh` were split for the map \throws Error(kUsage) where the asset
/// has no level
Picture preview(const SourceMesh& mesh, const Parameterization& map, Asset asset, std::int64_t source_triangles,
                const RenderOptions& options, std::vector<std::pair<std::string, Picture>> more = {},
                const SourceColour& colour = {});

}  // namespace lozenge
