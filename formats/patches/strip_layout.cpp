// Shelves: strips of one height side by side, the longest first, each on the first shelf that has room. Whether they
// fit is tried for ever smaller patches.
#include "formats/patches/strip_layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <optional>

#include "formats/base/error.h"
#include "formats/patches/map_layout.h"

namespace lozenge {

namespace {

constexpr std::int32_t kLeastSteps = 3;

std::int32_t steps_at(std::int32_t steps, std::int32_t first_level) {
  return std::max(steps >> first_level, kLeastSteps);
}

/// Highest first, then longest; stable.
std::vector<std::int32_t> order_of(const std::vector<PatchStrip>& strips) {
  std::vector<std::int32_t> order(strips.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](std::int32_t a, std::int32_t b) {
    if (strips[a].first_level != strips[b].first_level) return strips[a].first_level < strips[b].first_level;
    return strips[a].length() > strips[b].length();
  });
  return order;
}

std::optional<StripLayout> packed(const std::vector<PatchStrip>& strips, const std::vector<std::int32_t>& order,
                                  std::int64_t size, std::int32_t gutter, std::int32_t steps) {
  struct Shelf {
    std::int32_t steps;
    std::int64_t y;
    std::int64_t used;
  };
  StripLayout layout{static_cast<std::int32_t>(size), std::vector<StripTile>(strips.size())};
  std::vector<Shelf> shelves;
  std::size_t first_open = 0;
  std::int64_t used = 0;
  for (const std::int32_t s : order) {
    const std::int32_t here = steps_at(steps, strips[s].first_level);
    const std::int64_t width = std::int64_t{strips[s].length()} * here + 1 + 2 * std::int64_t{gutter};
    const std::int64_t height = std::int64_t{here} + 1 + 2 * std::int64_t{gutter};
    if (!shelves.empty() && shelves.back().steps != here) first_open = shelves.size();
    const auto room = std::find_if(shelves.begin() + static_cast<std::ptrdiff_t>(first_open), shelves.end(),
                                   [&](const Shelf& shelf) { return shelf.used + width <= size; });
    Shelf* shelf = room == shelves.end() ? nullptr : &*room;
    if (shelf == nullptr) {
      if (width > size || used + height > size) return std::nullopt;
      shelf = &shelves.emplace_back(Shelf{here, used, 0});
      used += height;
    }
    layout.tiles[s] = {static_cast<std::int32_t>(shelf->used) + gutter, static_cast<std::int32_t>(shelf->y) + gutter,
                       here, gutter};
    shelf->used += width;
  }
  return layout;
}

}  // namespace

std::int64_t least_strip_size(const std::vector<PatchStrip>& strips, std::int32_t gutter) {
  const std::vector<std::int32_t> order = order_of(strips);
  std::int64_t low = 0;
  std::int64_t high = 1;
  while (high <= kMostMapSize && !packed(strips, order, high, gutter, kLeastSteps)) high *= 2;
  while (high - low > 1) {
    const std::int64_t middle = (low + high) / 2;
    (packed(strips, order, middle, gutter, kLeastSteps) ? high : low) = middle;
  }
  return high;
}

StripLayout pack_strips(const std::vector<PatchStrip>& strips, std::int32_t size, std::int32_t gutter) {
  if (size < 1 || size > kMostMapSize) {
    throw Error(
        ExitCode::kUsage,
        fmt::format("an atlas of {0} x {0} texels can't be made; choose 1 to {1} texels a side", size, kMostMapSize));
  }
  if (gutter < 0 || gutter > size) {
    throw Error(ExitCode::kUsage, fmt::format("a gutter of {} texels is out of range; choose 0 to {}", gutter, size));
  }
  const std::vector<std::int32_t> order = order_of(strips);
  std::optional<StripLayout> best = packed(strips, order, size, gutter, kLeastSteps);
  if (!best) {
    throw Error(ExitCode::kLimit, fmt::format("{} charts with gutters of {} texels don't fit into an atlas of {} x {} "
                                              "texels; choose at least {} texels a side, or a smaller gutter",
                                              strips.size(), gutter, size, size, least_strip_size(strips, gutter)));
  }
  std::int32_t low = kLeastSteps;
  for (std::int32_t high = size; high - low > 1;) {
    const std::int32_t middle = (low + high) / 2;
    if (auto layout = packed(strips, order, size, gutter, middle)) {
      best = std::move(layout);
      low = middle;
    } else {
      high = middle;
    }
  }
  return *best;
}

}  // namespace lozenge
