// Which tiles of a texture patches have.
//
// Where nobody chooses, patch number p has tile number p. Mips of coarser texels than a tile mix tiles that lie side by
// side, whatever lies there on the surface; so it is worth choosing.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

namespace lozenge {

/// A permutation, or none: then every patch has the tile of its own number.
class TileOrder {
 public:
  TileOrder() = default;
  /// \param tiles  [patch] its tile \pre each of 0, 1, 2, ... once
  explicit TileOrder(std::vector<std::int32_t> tiles);

  bool is_given() const { return !tiles_.empty(); }
  std::int32_t tile_of(std::int32_t patch) const { return is_given() ? tiles_[patch] : patch; }
  std::int32_t patch_in(std::int32_t tile) const { return is_given() ? patches_[tile] : tile; }
  /// [patch] its tile; empty where no order is given.
  const std::vector<std::int32_t>& tiles() const { return tiles_; }

  friend bool operator==(const TileOrder&, const TileOrder&) = default;

 private:
  std::vector<std::int32_t> tiles_;    ///< [patch]
  std::vector<std::int32_t> patches_;  ///< [tile]
};

}  // namespace lozenge
