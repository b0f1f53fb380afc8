// A tile's contacts are found once, by asking the layout what lies beyond its sides; they are between places in the
// picture, and stay what they are when patches change places.
#include "formats/patches/mosaic.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace lozenge {

namespace {

/// What counts how much, for each side of a tile. Cells along a border are what is mixed in mips of a few texels to a
/// tile; in coarser ones it is whole tiles.
constexpr double kOfBorder = 0.8;
constexpr double kOfNeighbour = 0.2;
constexpr double kOfNextButOne = 0.3;
/// For each corner, of the cells that meet there and of the whole tiles.
constexpr double kOfCorner = 0.25;

}  // namespace

Look mean_look(const PatchLook& look) {
  Look mean{};
  for (const Look& cell : look) {
    for (std::size_t c = 0; c < cell.size(); ++c) mean[c] += cell[c] / static_cast<float>(look.size());
  }
  return mean;
}

/// The contacts of one tile with all others.
class Mosaic::ContactsOfTile {
 public:
  /// \param tiles  of the layout \param patches  that they are of
  ContactsOfTile(const MapLayout& layout, const std::vector<MapTile>& tiles, const MapTile& tile)
      : layout_(layout), tiles_(tiles), tile_(tile) {
    for (std::int32_t side = 0; side < 4; ++side) {
      for (std::int32_t k = 0; k < kLookCells; ++k) {
        const Vec2d beyond = place_beyond(side, k, 0);
        add(beyond, cell_along(side, k), kOfBorder / kLookCells);
        add(beyond, kWhole, kOfNeighbour / kLookCells);
        add(place_beyond(side, k, tile.size), kWhole, kOfNextButOne / kLookCells);
      }
    }
    for (std::int32_t corner = 0; corner < 4; ++corner) {
      const bool right = corner % 2 == 1;
      const bool below = corner / 2 == 1;
      const Vec2d beyond(right ? tile.x + tile.size : tile.x - 1, below ? tile.y + tile.size : tile.y - 1);
      add(beyond, (right ? kLookCells - 1 : 0) + (below ? kWhole - kLookCells : 0), kOfCorner);
      add(beyond, kWhole, kOfCorner);
    }
  }

  const std::vector<Contact>& found() const { return found_; }

 private:
  /// Sides are left, right, top, bottom; cells along them run right or down.
  static std::int32_t cell_along(std::int32_t side, std::int32_t k) {
    const std::int32_t last = side % 2 == 0 ? 0 : kLookCells - 1;
    return side < 2 ? last + kLookCells * k : k + kLookCells * last;
  }

  /// In the first texel beyond cell k of a side, and so many texels on.
  Vec2d place_beyond(std::int32_t side, std::int32_t k, double away) const {
    const double along = (k + 0.5) * tile_.size / kLookCells;
    const double outside = side % 2 == 0 ? -0.5 - away : tile_.size + 0.5 + away;
    return side < 2 ? Vec2d(tile_.x + outside, tile_.y + along) : Vec2d(tile_.x + along, tile_.y + outside);
  }

  /// With the tile that has the place, if one does: a cell with its cell there, all of this tile with all of it.
  void add(const Vec2d& place, std::int32_t part, double weight) {
    const auto x = static_cast<std::int32_t>(std::floor(place.x));
    const auto y = static_cast<std::int32_t>(std::floor(place.y));
    const std::int32_t patch = layout_.patch_at(x, y);
    if (patch < 0 || patch >= static_cast<std::int32_t>(tiles_.size())) return;
    const std::int32_t tile = layout_.order.tile_of(patch);
    const MapTile& other = tiles_[tile];
    const std::int32_t i = (x - other.x) * kLookCells / other.size;
    const std::int32_t j = (y - other.y) * kLookCells / other.size;
    const std::int32_t there = part == kWhole ? kWhole : i + kLookCells * j;
    const auto known = std::find_if(found_.begin(), found_.end(), [&](const Contact& c) {
      return c.part == part && c.other_tile == tile && c.other_part == there;
    });
    if (known != found_.end()) known->weight += static_cast<float>(weight);
    else found_.push_back({part, tile, there, static_cast<float>(weight)});
  }

  const MapLayout& layout_;
  const std::vector<MapTile>& tiles_;
  const MapTile& tile_;
  std::vector<Contact> found_;
};

Mosaic::Mosaic(const MapLayout& layout, const std::vector<PatchLook>& looks) : first_{0} {
  std::vector<MapTile> tiles;
  for (std::int32_t tile = 0; tile < static_cast<std::int32_t>(looks.size()); ++tile) {
    patch_in_.push_back(layout.order.patch_in(tile));
    tiles.push_back(layout.tile_of(patch_in_.back()));
  }
  for (const PatchLook& look : looks) {
    std::copy(look.begin(), look.end(), parts_.emplace_back().begin());
    parts_.back().back() = mean_look(look);
  }
  for (const MapTile& tile : tiles) {
    const ContactsOfTile of(layout, tiles, tile);
    contacts_.insert(contacts_.end(), of.found().begin(), of.found().end());
    first_.push_back(contacts_.size());
  }
}

float Mosaic::unlikeness_of(std::int32_t tile) const {
  // Number by number, which compilers do all at once.
  Look sum{};
  const auto& here = parts_[patch_in_[tile]];
  for (std::size_t k = first_[tile]; k < first_[tile + 1]; ++k) {
    const Contact& contact = contacts_[k];
    const Look& a = here[contact.part];
    const Look& b = parts_[patch_in_[contact.other_tile]][contact.other_part];
    for (std::size_t c = 0; c < sum.size(); ++c) sum[c] += contact.weight * (a[c] - b[c]) * (a[c] - b[c]);
  }
  return std::accumulate(sum.begin(), sum.end(), 0.0F);
}

double Mosaic::unlikeness() const {
  double sum = 0;
  for (std::int32_t tile = 0; tile < size(); ++tile) sum += unlikeness_of(tile);
  return sum;
}

TileOrder Mosaic::order() const {
  std::vector<std::int32_t> tiles(patch_in_.size());
  for (std::int32_t tile = 0; tile < size(); ++tile) tiles[patch_in_[tile]] = tile;
  return TileOrder(std::move(tiles));
}

}  // namespace lozenge
