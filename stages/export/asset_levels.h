// Which levels of detail an asset has, and of what triangles each part of each level is.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "formats/patches/baked_maps.h"
#include "formats/patches/geometry_image.h"
#include "stages/export/asset_writer.h"
#include "stages/export/export.h"
#include "stages/export/level_deviation.h"

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
  std::optional<LevelDeviations> deviations = {};  ///< where the source is known
  std::vector<BakedMap> maps = {};  ///< of its own; of kinds that aren't there it has the given ones, or none
};

struct AssetLevels {
  std::vector<LeveledPart> parts;  ///< that have any level
  std::vector<LevelFacts> facts;   ///< [level], finest first
};

/// The levels from `finest` of the image on that the options ask for (`LevelChain`). Where the source is known, they
/// are fitted to it; before them comes the source's own, where that is to be the finest one. A level that is no nearer
/// to the source than a coarser one isn't there. Without the source they are the image's samples.
/// \param maps     of the material, of this layout
/// \param normals  that of tangent-space normals, or null
/// \param source   null where it isn't known
/// \throws Error as `export_asset`
AssetLevels make_levels(const GeometryImage& image, const MapLayout& layout, int finest,
                        const std::vector<const BakedMap*>& maps, const BakedMap* normals, const ExportOptions& options,
                        const SourceSurface* source);

}  // namespace lozenge
