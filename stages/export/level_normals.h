// The normal map of each fitted level: a map's tangent-space normals are in the frames of the surface that it was baked
// for; other levels have frames of their own, and so maps of their own.
#pragma once

#include <vector>

#include "formats/patches/baked_maps.h"
#include "formats/patches/charted_surface.h"
#include "formats/patches/framed_surface.h"
#include "formats/patches/geometry_image.h"
#include "stages/export/level_sight.h"

namespace lozenge {

class LevelNormals {
 public:
  /// Keeps references to `map` and `sight`.
  /// \param map  tangent-space normals in the frames of the image's level that it names
  LevelNormals(const GeometryImage& image, const BakedMap& map, const LevelSight& sight);

  const BakedMap& map() const { return map_; }

  /// What the map says of what a texel sees of the source, in the level's frame there: goes into `made`.
  void paint(BakedMap& made, const SeenTexel& seen) const;

  /// The source's normal at a place of a patch, of any length.
  Vec3d of_source(std::int32_t patch, const Vec2d& place) const;

  /// The unit normal that one sees at a point of a level with its map.
  Vec3d shown_by(const BakedMap& map, const ChartedSurface& level, const FramedSurface& framed, TriangleId triangle,
                 const Vec3d& weights) const;

 private:
  Vec3d normal_at(const SeenPlace& seen) const;

  const BakedMap& map_;
  const Atlas& atlas_;
  std::vector<Vec3f> object_;  ///< [texel] the normal in the asset's space
};

}  // namespace lozenge
