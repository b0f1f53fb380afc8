// First both patches and tiles are halved and halved again, patches by what they look like, tiles by where they lie:
// that puts each among its like. Then two of one size are swapped at random, again and again, and stay so where the
// picture's unlikeness doesn't grow by more than a threshold, which falls to nearly nothing: threshold accepting (Dueck
// and Scheuer, Journal of Computational Physics 90, 1990), which needs no exponential and so gives the same everywhere.
#include "formats/patches/alike_tiles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <random>
#include <span>
#include <tuple>
#include <utility>

namespace lozenge {

namespace {

/// Tried for each tile, and at most.
constexpr std::int64_t kSwapsOfTile = 400;
constexpr std::int64_t kMostSwaps = 1'000'000;
/// Times that the threshold falls.
constexpr std::int64_t kSteps = 200;
/// Shares of a tile's unlikeness, on an average, before anything was moved.
constexpr double kFirstThreshold = 0.2;
constexpr double kLastThreshold = 2e-5;

/// Some things, each with so many numbers.
template <std::size_t kNumbers>
class Halves {
 public:
  explicit Halves(const std::vector<std::array<float, kNumbers>>& numbers) : numbers_(numbers) {}

  /// Puts the lower half of them first, by the number that differs most among them.
  void sort(std::span<std::int32_t> things) const {
    const std::size_t number = widest(things);
    std::sort(things.begin(), things.end(), [&](std::int32_t a, std::int32_t b) {
      return std::pair(numbers_[a][number], a) < std::pair(numbers_[b][number], b);
    });
  }

 private:
  std::size_t widest(std::span<const std::int32_t> things) const {
    std::array<double, kNumbers> sums{};
    std::array<double, kNumbers> spreads{};
    for (const std::int32_t thing : things) {
      for (std::size_t n = 0; n < kNumbers; ++n) sums[n] += numbers_[thing][n];
    }
    for (const std::int32_t thing : things) {
      for (std::size_t n = 0; n < kNumbers; ++n) {
        const double away = numbers_[thing][n] - sums[n] / static_cast<double>(things.size());
        spreads[n] += away * away;
      }
    }
    return static_cast<std::size_t>(std::max_element(spreads.begin(), spreads.end()) - spreads.begin());
  }

  const std::vector<std::array<float, kNumbers>>& numbers_;
};

using PatchHalves = Halves<std::tuple_size_v<Look>>;
using TileHalves = Halves<2>;

/// Sorts both, so that each patch comes to stand where its tile does. \pre as many patches as tiles
void halve(std::span<std::int32_t> patches, std::span<std::int32_t> tiles, const PatchHalves& by_look,
           const TileHalves& by_place) {
  if (patches.size() < 2) return;
  by_look.sort(patches);
  by_place.sort(tiles);
  const std::size_t half = patches.size() / 2;
  halve(patches.first(half), tiles.first(half), by_look, by_place);
  halve(patches.subspan(half), tiles.subspan(half), by_look, by_place);
}

TileOrder order_by_halves(const MapLayout& layout, const std::vector<PatchLook>& looks) {
  std::vector<std::int32_t> patches(looks.size());
  std::iota(patches.begin(), patches.end(), 0);
  std::vector<std::int32_t> tiles = patches;
  std::vector<Look> means;
  std::vector<std::array<float, 2>> places;
  for (const PatchLook& look : looks) means.push_back(mean_look(look));
  for (const std::int32_t number : tiles) {
    const MapTile tile = layout.tile_of(number);
    places.push_back({static_cast<float>(tile.x), static_cast<float>(tile.y)});
  }
  std::size_t first = 0;
  for (const std::int32_t count : layout.counts) {
    const auto of_size = [&](std::vector<std::int32_t>& all) {
      return std::span(all).subspan(first, static_cast<std::size_t>(count));
    };
    halve(of_size(patches), of_size(tiles), PatchHalves(means), TileHalves(places));
    first += static_cast<std::size_t>(count);
  }
  std::vector<std::int32_t> order(looks.size());
  for (std::size_t n = 0; n < order.size(); ++n) order[patches[n]] = tiles[n];
  return TileOrder(std::move(order));
}

/// Pairs of tiles of one size, at random.
class Pairs {
 public:
  explicit Pairs(const MapLayout& layout) {
    for (const std::int32_t count : layout.counts) {
      const auto first = static_cast<std::int32_t>(ranges_.size());
      ranges_.insert(ranges_.end(), static_cast<std::size_t>(count), {first, count});
    }
  }

  std::pair<std::int32_t, std::int32_t> next() {
    const std::int32_t tile = any_of(static_cast<std::int32_t>(ranges_.size()));
    return {tile, ranges_[tile].first + any_of(ranges_[tile].second)};
  }

 private:
  /// Distributions of the standard library differ from one to another.
  std::int32_t any_of(std::int32_t count) {
    return static_cast<std::int32_t>(random_() % static_cast<std::uint32_t>(count));
  }

  std::vector<std::pair<std::int32_t, std::int32_t>> ranges_;  ///< [tile] the first of its size, and how many there are
  std::mt19937 random_{1};
};

void try_swap(Mosaic& mosaic, std::int32_t a, std::int32_t b, double threshold) {
  const float before = mosaic.unlikeness_of(a) + mosaic.unlikeness_of(b);
  mosaic.swap(a, b);
  const float after = mosaic.unlikeness_of(a) + mosaic.unlikeness_of(b);
  if (double{after} - before > threshold) mosaic.swap(a, b);
}

}  // namespace

TileOrder order_of_alike(MapLayout layout, const std::vector<PatchLook>& looks) {
  layout.order = {};
  const double at_first = Mosaic(layout, looks).unlikeness();
  if (!(at_first > 0)) return {};
  Pairs pairs(layout);
  layout.order = order_by_halves(layout, looks);
  Mosaic mosaic(layout, looks);
  const std::int64_t swaps = std::min(kSwapsOfTile * mosaic.size(), kMostSwaps);
  double threshold = kFirstThreshold * at_first / mosaic.size();
  const double fall = std::pow(kLastThreshold / kFirstThreshold, 1.0 / kSteps);
  for (std::int64_t step = 0; step < kSteps; ++step, threshold *= fall) {
    for (std::int64_t n = 0; n < swaps / kSteps; ++n) {
      const auto [a, b] = pairs.next();
      if (a != b) try_swap(mosaic, a, b, threshold);
    }
  }
  return mosaic.order();
}

}  // namespace lozenge
