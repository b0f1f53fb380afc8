#include "formats/patches/shrunk_map.h"

#include <array>
#include <cmath>

#include "formats/base/parallel.h"

namespace lozenge {

namespace {

using Texel = std::array<double, 4>;

Texel mean_of(const BakedMap& map, std::int32_t left, std::int32_t top, std::int32_t side) {
  Texel sum{};
  const auto channels = static_cast<std::size_t>(map.channels);
  for (std::int32_t y = top; y < top + side; ++y) {
    for (std::int32_t x = left; x < left + side; ++x) {
      const std::size_t texel = static_cast<std::size_t>(y) * static_cast<std::size_t>(map.width()) + x;
      for (std::size_t c = 0; c < channels; ++c) sum[c] += map.texels[texel * channels + c];
    }
  }
  for (double& value : sum) value /= static_cast<double>(side) * side;
  return sum;
}

/// Nothing is left of opposite directions: then that of the first of the texels stands for all.
Texel direction_of(const BakedMap& map, const Texel& mean, std::int32_t left, std::int32_t top) {
  const double length = std::sqrt(mean[0] * mean[0] + mean[1] * mean[1] + mean[2] * mean[2]);
  if (!(length > 0)) return mean_of(map, left, top, 1);
  return {mean[0] / length, mean[1] / length, mean[2] / length, 0};
}

}  // namespace

BakedMap shrunk(const BakedMap& map, std::int32_t times) {
  BakedMap small = neutral_map(map.kind, map.layout, map.level, times * map.shrink, map.channels);
  const bool directions = traits_of(map.kind).values == MapValues::kDirections;
  for_each_part(static_cast<std::size_t>(small.height()), [&](std::size_t begin, std::size_t end) {
    for (std::size_t y = begin; y < end; ++y) {
      for (std::int32_t x = 0; x < small.width(); ++x) {
        const std::int32_t left = x * times;
        const std::int32_t top = static_cast<std::int32_t>(y) * times;
        Texel value = mean_of(map, left, top, times);
        if (directions) value = direction_of(map, value, left, top);
        for (int c = 0; c < map.channels; ++c) {
          const std::size_t at = (y * static_cast<std::size_t>(small.width()) + x) * map.channels + c;
          small.texels[at] = static_cast<float>(value[static_cast<std::size_t>(c)] + 0.0);
        }
      }
    }
  });
  return small;
}

}  // namespace lozenge
