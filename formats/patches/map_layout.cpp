// Tiles are numbered in units of their own size: number n of size 2^-k lies in cell n / 4^k, and in that along a
// Z-shaped curve, whose bits are those of its column and its row there in turn. Larger tiles come first, so all before
// tile n fill whole tiles of its size.
#include "formats/patches/map_layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

#include "formats/base/error.h"

namespace lozenge {

namespace {

using Counts = std::array<std::int32_t, kMostFirstLevel + 1>;

/// Tiles of this many texels, or a multiple, begin no texel of the first three mips across two of them.
constexpr std::int32_t kAligned = 8;
/// The least that shows anything: 4 inner texels and a gutter of one.
constexpr std::int32_t kLeastTile = 6;

/// [k] patches of first level k; those of levels beyond `smallest` count there.
Counts counts_of(const PatchLayout& patches, std::int32_t smallest) {
  Counts counts{};
  for (std::int32_t p = 0; p < patches.size(); ++p) ++counts[std::min(patches.first_level(p), smallest)];
  return counts;
}

/// Tiles of size 2^-k that the larger ones take up.
std::int64_t number_before(const Counts& counts, std::int32_t k) {
  std::int64_t before = 0;
  for (std::int32_t larger = 0; larger < k; ++larger) before = 4 * (before + counts[larger]);
  return before;
}

std::int64_t cells_of(const Counts& counts) {
  const std::int64_t smallest = number_before(counts, kMostFirstLevel) + counts[kMostFirstLevel];
  const std::int64_t of_cell = std::int64_t{1} << (2 * kMostFirstLevel);
  return (smallest + of_cell - 1) / of_cell;
}

std::int32_t columns_of(const Counts& counts) {
  const std::int64_t cells = cells_of(counts);
  auto columns = static_cast<std::int32_t>(std::sqrt(static_cast<double>(cells)));
  while (std::int64_t{columns} * columns < cells) ++columns;
  return std::max(columns, 1);
}

/// The even bits of a number, closed up.
std::int32_t even_bits(std::int64_t number) {
  std::int32_t bits = 0;
  for (std::int32_t b = 0; b < kMostFirstLevel; ++b) bits |= static_cast<std::int32_t>((number >> (2 * b)) & 1) << b;
  return bits;
}

/// The number whose even bits are those of `x`, and whose odd ones are those of `y`.
std::int64_t interleaved(std::int32_t x, std::int32_t y) {
  std::int64_t number = 0;
  for (std::int32_t b = 0; b < kMostFirstLevel; ++b) {
    number |= static_cast<std::int64_t>((x >> b) & 1) << (2 * b) | static_cast<std::int64_t>((y >> b) & 1)
                                                                       << (2 * b + 1);
  }
  return number;
}

/// The coarsest mip that a gutter is wide enough for. A patch's border is the middle of its first texel; where half a
/// texel of the mip is no more than the gutter and half a texel, the bilinear look-up there has no use for what lies
/// beyond the tile.
std::int32_t mips_for(std::int32_t gutter) {
  return static_cast<std::int32_t>(std::bit_width(2 * static_cast<std::uint32_t>(gutter) + 1)) - 1;
}

/// Whether tiles of all sizes of this layout are multiples of the texels of each mip that their gutters are wide enough
/// for.
bool is_aligned(const MapLayout& layout) {
  for (std::int32_t k = 0; k <= kMostFirstLevel; ++k) {
    const std::int32_t side = layout.tile >> k;
    if (layout.counts[k] > 0 && side % (1 << mips_for(layout.gutter_of(side))) != 0) return false;
  }
  return true;
}

/// `layout` with the largest cells that fit into its width, or of 0 texels where none is large enough.
MapLayout with_largest_tile(MapLayout layout, std::int32_t smallest) {
  layout.columns = columns_of(layout.counts);
  layout.tile = layout.width / layout.columns;
  if (smallest == 0 && layout.tile < kAligned) {
    if (layout.tile < kLeastTile) layout.tile = 0;
    return layout;
  }
  const std::int32_t unit = kAligned << smallest;
  layout.tile = layout.tile / unit * unit;
  while (layout.tile > 0 && !is_aligned(layout)) layout.tile -= unit;
  return layout;
}

}  // namespace

std::int32_t MapLayout::gutter_of(std::int32_t tile_size) const { return std::min(gutter, std::max(tile_size / 8, 1)); }

bool MapLayout::keeps_apart(std::int32_t tile_size, std::int32_t texel) const {
  return texel <= 2 * gutter_of(tile_size) + 1 && tile_size % texel == 0 && width % texel == 0 && height % texel == 0;
}

std::int32_t MapLayout::clean_mips() const {
  std::int32_t mips = 0;
  for (bool all = true; all; mips += all ? 1 : 0) {
    for (std::int32_t k = 0; k <= kMostFirstLevel; ++k) {
      all = all && (counts[k] == 0 || keeps_apart(tile >> k, 2 << mips));
    }
  }
  return mips;
}

std::int32_t MapLayout::smallest_tile() const {
  std::int32_t k = kMostFirstLevel;
  while (k > 0 && counts[k] == 0) --k;
  return tile >> k;
}

std::int32_t MapLayout::rows() const {
  return static_cast<std::int32_t>((cells_of(counts) + columns - 1) / std::max(columns, 1));
}

std::int32_t MapLayout::patches() const { return std::accumulate(counts.begin(), counts.end(), 0); }

MapTile MapLayout::tile_of(std::int32_t patch) const {
  std::int32_t among = order.tile_of(patch);
  std::int32_t k = 0;
  while (k < kMostFirstLevel && among >= counts[k]) among -= counts[k++];
  const std::int64_t number = number_before(counts, k) + among;
  const auto cell = static_cast<std::int32_t>(number >> (2 * k));
  const std::int64_t inside = number & ((std::int64_t{1} << (2 * k)) - 1);
  const std::int32_t side = tile >> k;
  return {cell % columns * tile + even_bits(inside) * side, cell / columns * tile + even_bits(inside >> 1) * side, side,
          gutter_of(side)};
}

std::int32_t MapLayout::patch_at(std::int32_t x, std::int32_t y) const {
  if (x < 0 || y < 0 || x >= columns * tile) return -1;
  const std::int64_t cell = std::int64_t{y / tile} * columns + x / tile;
  std::int32_t first = 0;
  for (std::int32_t k = 0; k <= kMostFirstLevel; first += counts[k++]) {
    if (counts[k] == 0) continue;
    const std::int32_t side = tile >> k;
    const std::int64_t number = (cell << (2 * k)) + interleaved(x % tile / side, y % tile / side);
    const std::int64_t among = number - number_before(counts, k);
    if (among < 0) return -1;
    if (among < counts[k]) return order.patch_in(first + static_cast<std::int32_t>(among));
  }
  return -1;
}

Vec2d MapLayout::texcoord(std::int32_t patch, double u, double v) const {
  const MapTile of = tile_of(patch);
  const double x = of.x + of.gutter + 0.5 + u * (of.inner() - 1);
  const double y = of.y + of.gutter + 0.5 + v * (of.inner() - 1);
  return {x / width, y / height};
}

bool MapLayout::fits(const PatchLayout& patches_of_image) const {
  std::int32_t smallest = kMostFirstLevel;
  while (smallest > 0 && counts[smallest] == 0) --smallest;
  // Maps of the format's first version told of rows and columns alone.
  const std::int32_t spare = counts[0] - patches_of_image.size();
  if (smallest == 0) return spare >= 0 && spare < columns;
  return counts == counts_of(patches_of_image, smallest);
}

std::int64_t least_map_size(const PatchLayout& patches) {
  std::int64_t least = INT64_MAX;
  for (std::int32_t smallest = 0; smallest <= kMostFirstLevel; ++smallest) {
    const std::int64_t tile = smallest == 0 ? kLeastTile : kAligned << smallest;
    least = std::min(least, tile * columns_of(counts_of(patches, smallest)));
  }
  return least;
}

std::int32_t default_map_size(const PatchLayout& patches) {
  constexpr std::int32_t kUsual = 2048;
  constexpr std::int32_t kMostByItself = 8192;
  constexpr std::int32_t kFineTile = 16;
  const auto is_fine = [&](std::int32_t size) { return make_map_layout(patches, size, 0).tile >= kFineTile; };
  const std::int64_t least = least_map_size(patches);
  std::int32_t size = kUsual;
  while (size < kMostMapSize && (size < least || (size < kMostByItself && !is_fine(size)))) size *= 2;
  return size;
}

std::int32_t default_gutter(const PatchLayout& patches, std::int32_t size) {
  constexpr double kOfTile = 2.0 / 3;
  constexpr double kOfOthers = 0.8;
  const auto texels = [](const MapLayout& layout) { return double{1} * layout.inner() * layout.inner(); };
  std::int32_t gutter = size > 2048 ? size / 512 : 4;
  const double least = kOfOthers * texels(make_map_layout(patches, size, gutter));
  while (2 * gutter <= size) {
    const MapLayout wider = make_map_layout(patches, size, 2 * gutter);
    const bool fits = wider.gutter_of(wider.tile) == 2 * gutter;
    if (!fits || texels(wider) < kOfTile * wider.tile * wider.tile || texels(wider) < least) break;
    gutter *= 2;
  }
  return gutter;
}

MapLayout make_map_layout(const PatchLayout& patches, std::int32_t size, std::int32_t gutter) {
  if (size < 1 || size > kMostMapSize) {
    throw Error(
        ExitCode::kUsage,
        fmt::format("a texture of {0} x {0} texels can't be made; choose 1 to {1} texels a side", size, kMostMapSize));
  }
  if (gutter < 0 || gutter > size) {
    throw Error(ExitCode::kUsage, fmt::format("a gutter of {} texels is out of range; choose 0 to {}", gutter, size));
  }
  MapLayout layout{size, size, 0, 0, gutter, {}};
  for (std::int32_t smallest = 0; smallest <= kMostFirstLevel; ++smallest) {
    const MapLayout found = with_largest_tile({size, size, 0, 0, gutter, counts_of(patches, smallest)}, smallest);
    if (found.tile > layout.tile) layout = found;
  }
  if (layout.tile == 0) {
    throw Error(ExitCode::kLimit, fmt::format("{} patches don't fit into a texture of {} x {} texels; choose at least "
                                              "{} texels a side",
                                              patches.size(), size, size, least_map_size(patches)));
  }
  return layout;
}

}  // namespace lozenge
