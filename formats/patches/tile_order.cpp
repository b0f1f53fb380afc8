#include "formats/patches/tile_order.h"

namespace lozenge {

TileOrder::TileOrder(std::vector<std::int32_t> tiles) : tiles_(std::move(tiles)), patches_(tiles_.size()) {
  for (std::size_t patch = 0; patch < tiles_.size(); ++patch) {
    patches_[static_cast<std::size_t>(tiles_[patch])] = static_cast<std::int32_t>(patch);
  }
}

}  // namespace lozenge
