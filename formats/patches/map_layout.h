// How patches lie in a texture.
//
// The tiles of patches whose first level is 0 are the cells of a grid. A patch of first level k has a tile of half the
// side k times over: four of these share a cell of the next larger ones, so that tiles of all sizes fill the texture
// without a gap, one after the other in the order of the patches.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "formats/base/vector.h"
#include "formats/patches/patch_layout.h"
#include "formats/patches/tile_order.h"

namespace lozenge {

/// The tile of one patch, in texels: a border of `gutter` texels on every side repeats what lies across the border.
///
/// Texel centres of the inner square cover u, v in [0, 1] evenly, borders included: inner texel k of n = inner() is at
/// u = k / (n - 1).
struct MapTile {
  std::int32_t x = 0;  ///< of its first texel
  std::int32_t y = 0;
  std::int32_t size = 0;  ///< a side
  std::int32_t gutter = 0;

  std::int32_t inner() const { return size - 2 * gutter; }
};

/// A texture's tiles: `columns` x `rows` cells in its top left part.
struct MapLayout {
  std::int32_t width = 0;  ///< of the whole texture, in texels
  std::int32_t height = 0;
  std::int32_t columns = 0;  ///< cells side by side
  std::int32_t tile = 0;     ///< a side of a cell, in texels: a multiple of 2^k for each k that has patches
  std::int32_t gutter = 0;   ///< of tiles of 8 times as many texels or more; see `gutter_of`
  /// [k] patches whose tiles are 2^-k times as large as a cell, a side.
  std::array<std::int32_t, kMostFirstLevel + 1> counts{};
  TileOrder order{};  ///< of all tiles; each patch has one of its size

  /// Texels of the gutter of a tile: an eighth of it at most, but one where there are any.
  std::int32_t gutter_of(std::int32_t tile_size) const;
  /// Inner texels a side of the largest tiles.
  std::int32_t inner() const { return tile - 2 * gutter_of(tile); }
  std::int32_t smallest_tile() const;
  /// Whether texels of a coarser picture, each as wide as so many of these, mix no tile of this size with another: none
  /// begins across two tiles, and the bilinear look-up at a patch's border has no use for what lies beyond the tile.
  bool keeps_apart(std::int32_t tile_size, std::int32_t texel) const;
  /// The coarsest mip in which no two tiles are mixed; 0 is the texture itself.
  std::int32_t clean_mips() const;
  std::int32_t rows() const;  ///< of cells
  std::int32_t patches() const;

  /// \pre 0 <= patch < patches()
  MapTile tile_of(std::int32_t patch) const;
  /// The patch whose tile holds a texel; -1 where there is none.
  std::int32_t patch_at(std::int32_t x, std::int32_t y) const;
  /// Index of texel (x, y) of a tile, counted from its first, in a map whose texels are each `shrink` of the layout's
  /// wide.
  std::size_t texel_of(const MapTile& of, std::int32_t x, std::int32_t y, std::int32_t shrink) const {
    return static_cast<std::size_t>(of.y / shrink + y) * static_cast<std::size_t>(width / shrink) +
           static_cast<std::size_t>(of.x / shrink + x);
  }
  /// Texture coordinates (glTF's convention, v down) of the place (u, v) of a patch; beyond 0..1 in its gutter.
  Vec2d texcoord(std::int32_t patch, double u, double v) const;

  /// Whether the tiles can be those of these patches.
  bool fits(const PatchLayout& patches_of_image) const;

  friend bool operator==(const MapLayout&, const MapLayout&) = default;
};

/// Texels of a map's side.
inline constexpr std::int32_t kMostMapSize = 32768;

/// Side of the smallest square texture that the tiles of these patches fit into, in texels.
std::int64_t least_map_size(const PatchLayout& patches);

/// Texels of a square texture's side where nobody asked for a size: 2048, or what gives the largest tiles 16 texels, up
/// to 8192 or what they need at least.
std::int32_t default_map_size(const PatchLayout& patches);

/// Texels of the gutter where nobody asked for any: 4, and of textures above 2048 as many as mips need that are as
/// coarse beside the tiles; twice as many, and so on, as long as that leaves patches two thirds of their tiles'
/// texels, and four fifths of those that they would have had. Renderers look far down into mips: at surfaces that are
/// nearly edge-on. \throws Error as `make_map_layout`
std::int32_t default_gutter(const PatchLayout& patches, std::int32_t size);

/// The layout of the largest tiles for which those of all patches fit into a square texture of `size` texels. A tile is
/// a multiple of 8 texels, where that many fit, and of more where its gutter is 8 or wider, so that no mip for which a
/// gutter is wide enough begins a texel across two tiles; patches whose tiles would be smaller than 8 texels get larger
/// ones.
/// \throws Error(kUsage) where `size` or `gutter` is out of range (1..kMostMapSize, 0..size), Error(kLimit) where the
/// tiles don't fit (`least_map_size`)
MapLayout make_map_layout(const PatchLayout& patches, std::int32_t size, std::int32_t gutter);

}  // namespace lozenge
