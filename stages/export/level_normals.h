// The normal map of each fitted level: a map's tangent-space normals are in the frames of the surface that it was baked
// for; other levels have frames of their own, and so maps of their own.
#pragma once

#include <vector>

#include "formats/patches/atlas.h"
#include "formats/patches/baked_maps.h"
#include "formats/patches/charted_surface.h"
#include "formats/patches/framed_surface.h"
#include "formats/patches/geometry_image.h"
#include "formats/patches/triangle_tile.h"
#include "formats/surface/facing_hits.h"

namespace lozenge {

class LevelNormals {
 public:
  /// Keeps references to all.
  /// \param map     tangent-space normals in the frames of the image's level that it names
  /// \param source  in the same atlas \param scene  of its triangles
  LevelNormals(const GeometryImage& image, const BakedMap& map, const ChartedSurface& source, const RayScene& scene);

  /// What the map says of the source where it is seen from a level's surface, along its normals, in that one's frames.
  /// \param shrink  of the map; see `most_shrink`
  BakedMap seen_from(const ChartedSurface& level, const FramedSurface& framed, std::int32_t shrink) const;

  /// What a map may shrink the layout by where it is to have 1 / `wish`, a power of two, of the given map's side: no
  /// texel lies across two tiles, and gutters keep a texel at least.
  std::int32_t most_shrink(std::int32_t wish) const;

  /// The source's normal at a place of a patch, of any length.
  Vec3d of_source(std::int32_t patch, const Vec2d& place) const { return normal_at(patch, place); }

  /// The unit normal that one sees at a point of a level with its map.
  Vec3d shown_by(const BakedMap& map, const ChartedSurface& level, const FramedSurface& framed, TriangleId triangle,
                 const Vec3d& weights) const;

 private:
  class LevelTriangle;
  struct Row;
  /// Of the map that is made of one patch.
  struct Texels {
    std::int32_t patch = -1;
    std::int32_t shrink = 1;
    std::int32_t rays = 1;  ///< a side of a texel
  };

  double cage_of(const ChartedSurface& level) const;
  Row row_of(const TriangleTile& tile, const std::vector<LevelTriangle>& drawn, std::int32_t y,
             const Texels& texels) const;
  std::vector<Vec3d> normals_of(const Row& row, double cage, std::int32_t patch) const;
  Vec3d normal_at(const RayHit& hit) const;
  Vec3d normal_at(std::int32_t patch, const Vec2d& place) const;

  Atlas atlas_;
  const BakedMap& map_;
  const ChartedSurface& source_;
  const RayScene& scene_;
  std::vector<std::int32_t> parts_;  ///< [patch] the connected part of the surface: none is seen through another's map
  double diagonal_;                  ///< of the source's bounding box
  std::vector<Vec3f> object_;        ///< [texel] the normal in the asset's space
};

}  // namespace lozenge
