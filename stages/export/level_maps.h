// The maps of each fitted level: what the source's maps show, seen from the level's surface.
//
// A coarse level's triangles don't show each place of the atlas where it is on the source; with maps of its own a level
// does, each of about half the side of those of the level before. Gutters go on with what lies at the end of the
// patch's own triangles: what the atlas has beyond a border needn't be there any more where corners of patches have
// gone.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "stages/export/level_normals.h"
#include "stages/export/level_sight.h"

namespace lozenge {

class LevelMaps {
 public:
  /// Keeps references to all.
  /// \param maps     of one layout, besides that of normals: those whose numbers hold in any frames are seen from
  /// levels,
  ///                 all others left out
  /// \param normals  tangent-space normals, or null
  /// \param source   in the same atlas \param scene  of its triangles
  LevelMaps(const GeometryImage& image, const MapLayout& layout, const std::vector<const BakedMap*>& maps,
            const BakedMap* normals, const ChartedSurface& source, const RayScene& scene);

  /// Null where there are none.
  const LevelNormals* normals() const { return normals_ ? &*normals_ : nullptr; }

  /// \param wish  a power of two: how many times smaller, a side, than the given ones they are to be, if tiles and
  /// gutters allow
  std::vector<BakedMap> seen_from(const ChartedSurface& level, const FramedSurface& framed, std::int32_t wish) const;

 private:
  LevelSight sight_;
  std::optional<LevelNormals> normals_;
  std::vector<const BakedMap*> numbers_;  ///< that hold in any frames
};

}  // namespace lozenge
