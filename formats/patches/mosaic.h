// Who lies beside whom in a texture, and how unlike they look there.
//
// From far away a renderer looks a texture up in mips whose texels are as wide as a tile, or a quarter of one, and
// mixes what lies side by side in the picture. Gutters don't reach so far. But which patch has which tile is free, and
// where neighbours look alike there is nothing to mix.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "formats/patches/map_layout.h"

namespace lozenge {

/// What one sees of a piece of surface, as numbers from 0 to 1: two pieces are as unlike as the squares of their
/// differences add up to. What they are is up to who makes them.
using Look = std::array<float, 8>;

/// Cells along a side of a patch.
inline constexpr std::int32_t kLookCells = 4;

/// Means over 4 x 4 cells of a patch's square, row by row: cell (i, j) covers u from i / 4 to (i + 1) / 4.
using PatchLook = std::array<Look, std::size_t{kLookCells} * kLookCells>;

/// The mean over all of the square.
Look mean_look(const PatchLook& look);

class Mosaic {
 public:
  /// Patches on their tiles. \param looks  [patch] \pre the layout has as many tiles
  Mosaic(const MapLayout& layout, const std::vector<PatchLook>& looks);

  std::int32_t size() const { return static_cast<std::int32_t>(patch_in_.size()); }

  /// How unlike a tile and those around it are: along borders, as wholes, and as wholes one tile apart.
  float unlikeness_of(std::int32_t tile) const;
  /// Of all tiles.
  double unlikeness() const;

  /// Patches change places. \pre the tiles are of one size
  void swap(std::int32_t tile, std::int32_t other) { std::swap(patch_in_[tile], patch_in_[other]); }

  TileOrder order() const;

 private:
  static constexpr std::int32_t kWhole = kLookCells * kLookCells;

  /// Two parts of the picture that are compared: numbers of cells, or kWhole.
  struct Contact {
    std::int32_t part = 0;
    std::int32_t other_tile = 0;
    std::int32_t other_part = 0;
    float weight = 0;
  };
  class ContactsOfTile;

  std::vector<std::int32_t> patch_in_;               ///< [tile]
  std::vector<std::array<Look, kWhole + 1>> parts_;  ///< [patch] its cells, and all of it
  std::vector<std::size_t> first_;                   ///< [tile] into contacts_; one more at the end
  std::vector<Contact> contacts_;
};

}  // namespace lozenge
