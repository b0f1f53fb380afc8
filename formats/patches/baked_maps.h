// Texture maps over the atlas of a geometry image.
#pragma once

#include <cstdint>
#include <vector>

#include "formats/base/vector.h"
#include "formats/patches/map_kinds.h"

namespace lozenge {

/// How patches lie in a texture: the tile grid of the geometry image, each tile t x t texels, of which a border of
/// `gutter` texels on every side repeats what lies across the border.
///
/// Texel centres of the inner square cover u, v in [0, 1] evenly, borders included: inner texel k of n = t - 2 gutter
/// is at u = k / (n - 1).
struct MapLayout {
  std::int32_t width = 0;  ///< of the whole texture, in texels; the tiles fill its top left part
  std::int32_t height = 0;
  std::int32_t columns = 0;  ///< tiles side by side
  std::int32_t rows = 0;
  std::int32_t tile = 0;  ///< t
  std::int32_t gutter = 0;

  std::int32_t inner() const { return tile - 2 * gutter; }
  /// Texture coordinates (glTF's convention, v down) of the place (u, v) of a patch.
  Vec2d texcoord(std::int32_t patch, double u, double v) const {
    const double x = (patch % columns) * tile + gutter + 0.5 + u * (inner() - 1);
    const double y = (patch / columns) * tile + gutter + 0.5 + v * (inner() - 1);
    return {x / width, y / height};
  }
};

/// Texels of a map's side.
inline constexpr std::int32_t kMostMapSize = 32768;

/// Side of the smallest square texture that `columns` x `rows` tiles fit into, in texels.
std::int64_t least_map_size(std::int32_t columns, std::int32_t rows, std::int32_t gutter);

/// The largest tile for which `columns` x `rows` tiles fit into a square texture of `size` texels.
/// \throws Error(kUsage) where `size` or `gutter` is out of range (1..kMostMapSize, 0..size), Error(kLimit) where a
/// tile would have fewer than 4 inner texels, or no more than its gutter
MapLayout make_map_layout(std::int32_t columns, std::int32_t rows, std::int32_t size, std::int32_t gutter);

/// One map: `channels` floats a texel, row by row from the top. Normals are unit vectors, occlusion is 0 (dark) to 1,
/// positions are in the asset's units; what else there is to know of its kind is in map_kinds.h.
///
/// All maps of a surface have the same texture coordinates, hence the same layout. A map of lower resolution
/// (occlusion) has one texel for every `shrink` x `shrink` texels of the layout: its centre is the middle of theirs.
struct BakedMap {
  MapKind kind = MapKind::kTangentNormal;
  MapLayout layout;
  std::int32_t channels = 3;
  std::vector<float> texels;
  std::int32_t shrink = 1;  ///< divides the layout's width and height
  std::int32_t level = 0;   ///< the level of detail that it was baked for

  std::int32_t width() const { return layout.width / shrink; }    ///< in texels of this map
  std::int32_t height() const { return layout.height / shrink; }  ///< in texels of this map
};

/// A map whose texels are all neutral. \param shrink  divides the layout's width and height
BakedMap neutral_map(MapKind kind, const MapLayout& layout, std::int32_t level, std::int32_t shrink = 1);

struct BakeStatistics {
  std::int64_t texels = 0;  ///< baked, over all maps, gutters left out
  std::int64_t rays = 0;
  double rays_per_second = 0;        ///< a time: left out of every output but the report
  std::int64_t fallback_texels = 0;  ///< whose ray missed or hit a back side, and took the correspondence's point
  double cage_distance = 0;          ///< in the asset's units
  /// Inside of patches, over all maps, but beyond the surface's boundary: they mirror what lies before it, so that
  /// filtering doesn't show the edge. Not among the others.
  std::int64_t unused_texels = 0;
};

struct BakedMaps {
  std::vector<BakedMap> maps;
  /// The level of detail whose tangent frames the tangent-space normals are in.
  std::int32_t level = 0;
  BakeStatistics statistics;

  /// Nothing where it wasn't baked.
  const BakedMap* find(MapKind kind) const;
  /// The map that holds only for the tangent frames of the level that it was baked for; nothing where there is none.
  const BakedMap* find_in_level_frames() const;
};

}  // namespace lozenge
