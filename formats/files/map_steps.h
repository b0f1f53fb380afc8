// A map's numbers as the integers that pictures hold.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "formats/patches/map_kinds.h"

namespace lozenge {

/// The steps of an integer channel that are nearest to a map's values.
template <typename Step>
std::vector<Step> quantized(const MapTraits& traits, std::int32_t channels, const std::vector<float>& texels) {
  constexpr double kMost = std::numeric_limits<Step>::max();
  std::vector<Step> steps(texels.size());
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const auto channel = static_cast<std::int32_t>(i % static_cast<std::size_t>(channels));
    steps[i] = static_cast<Step>(std::lround(stored_share(traits, channel, texels[i]) * kMost));
  }
  return steps;
}

/// What the steps mean; quantized again, they give the same steps.
template <typename Step>
std::vector<float> values_of(const MapTraits& traits, std::int32_t channels, const std::vector<Step>& steps) {
  constexpr double kMost = std::numeric_limits<Step>::max();
  std::vector<float> values(steps.size());
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const auto channel = static_cast<std::int32_t>(i % static_cast<std::size_t>(channels));
    values[i] = static_cast<float>(value_of_share(traits, channel, steps[i] / kMost));
  }
  return values;
}

/// Leaves the values as they are after both, without a copy: maps may be large.
template <typename Step>
void round_to_steps(const MapTraits& traits, std::int32_t channels, std::vector<float>& texels) {
  constexpr double kMost = std::numeric_limits<Step>::max();
  for (std::size_t i = 0; i < texels.size(); ++i) {
    const auto channel = static_cast<std::int32_t>(i % static_cast<std::size_t>(channels));
    const auto step = static_cast<Step>(std::lround(stored_share(traits, channel, texels[i]) * kMost));
    texels[i] = static_cast<float>(value_of_share(traits, channel, step / kMost));
  }
}

}  // namespace lozenge
