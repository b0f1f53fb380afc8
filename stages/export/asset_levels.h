// Which levels of detail an asset has, and of what triangles each part of each level is.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "formats/patches/geometry_image.h"
#include "stages/export/asset_writer.h"
#include "stages/export/export.h"

namespace lozenge {

/// What is placed as a whole: all that stands still, or a body that doesn't.
struct LeveledPart {
  Body body;
  std::vector<PartLevel> levels;  ///< finest first; those of which nothing is left without caps are none
};

struct LevelFacts {
  int level = 0;                      ///< of the image; the source level counts as the finest one that it stands for
  std::int64_t cap_triangles = 0;     ///< that lay on caps and are left out
  std::int64_t source_triangles = 0;  ///< that are the source's own
};

struct AssetLevels {
  std::vector<LeveledPart> parts;  ///< that have any level
  std::vector<LevelFacts> facts;   ///< [level], finest first
};

/// The levels from `finest` of the image on that the options ask for; before them the source's own, where that is to be
/// the finest one.
/// \param frame_level  the level whose tangent frames normal maps are in
/// \param source       null where it isn't known
/// \throws Error as `export_asset`
AssetLevels make_levels(const GeometryImage& image, const MapLayout& layout, int finest, int frame_level,
                        const ExportOptions& options, const SourceSurface* source);

}  // namespace lozenge
