// What one sees of the source from the surface of a level of detail: for each texel of a map of that level, the places
// of the source that lie before or behind it, along its normals.
//
// So a level may show the source where it is, whatever has become of triangles and of their places in the atlas; and
// whatever went into the source's maps goes into the level's.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "formats/patches/atlas.h"
#include "formats/patches/charted_surface.h"
#include "formats/patches/framed_surface.h"
#include "formats/patches/geometry_image.h"
#include "formats/patches/triangle_tile.h"
#include "formats/surface/facing_hits.h"

namespace lozenge {

/// A place of the source.
struct SeenPlace {
  std::int32_t patch = -1;
  Vec2d place;            ///< shares of the patch's side
  Vec3d normal{0, 0, 0};  ///< the source's own, a unit vector; 0 where no ray met it: then the place is the texel's own
};

/// One texel of a level's map.
struct SeenTexel {
  std::size_t texel = 0;  ///< its index in the map
  ShadingFrame frame;     ///< the level's
  std::span<const SeenPlace> places;
};

/// One triangle of a level as its texels need it.
class SeeingTriangle {
 public:
  SeeingTriangle(const ChartedSurface& level, const FramedSurface& framed, std::int32_t number);

  /// Of a place, or of one on the triangle beside it.
  Vec3d weights(const Vec2d& place) const;
  Vec3d position(const Vec3d& w) const { return positions_[0] * w.x + positions_[1] * w.y + positions_[2] * w.z; }
  /// Of any length.
  Vec3d normal(const Vec3d& w) const {
    return Vec3d(vertices_[0]->normal) * w.x + Vec3d(vertices_[1]->normal) * w.y + Vec3d(vertices_[2]->normal) * w.z;
  }
  ShadingFrame frame(const Vec3d& w) const { return shading_frame(vertices_, w); }

 private:
  std::array<Vec2d, 3> places_;
  std::array<Vec3d, 3> positions_;
  std::array<const FrameVertex*, 3> vertices_{};
};

class LevelSight {
 public:
  /// Keeps references to all. \param layout  of the maps \param source  in the same atlas \param scene  of its
  /// triangles
  LevelSight(const GeometryImage& image, const MapLayout& layout, const ChartedSurface& source, const RayScene& scene);

  const Atlas& atlas() const { return atlas_; }

  /// Texels of a map: their size, and how many rays each looks along.
  struct Texels {
    std::int32_t shrink = 1;  ///< of the map; see `most_shrink`
    std::int32_t rays = 1;    ///< a side
  };
  /// `visit` for each texel of each patch's tile, gutters too, patches in parallel.
  void look(const ChartedSurface& level, const FramedSurface& framed, const Texels& texels,
            const std::function<void(const SeenTexel&)>& visit) const;

  /// What a map may shrink the layout by where it is to have 1 / `wish`, a power of two, of the side of a map that
  /// shrinks it by `given`: no texel lies across two tiles, and no bilinear look-up in a patch
  /// reads another tile.
  std::int32_t most_shrink(std::int32_t given, std::int32_t wish) const;

 private:
  struct Row;

  double cage_of(const ChartedSurface& level) const;
  Row row_of(const TriangleTile& tile, const std::vector<SeeingTriangle>& drawn, std::int32_t patch, std::int32_t y,
             const Texels& texels) const;
  std::vector<SeenPlace> places_of(const Row& row, double cage, std::int32_t patch) const;

  Atlas atlas_;
  const ChartedSurface& source_;
  const RayScene& scene_;
  std::vector<std::int32_t> parts_;  ///< [patch] the connected part of the surface: none is seen through another's map
  double diagonal_;                  ///< of the source's bounding box
};

}  // namespace lozenge
