// Where the samples of each patch lie in an array that holds them patch by patch, row by row.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "formats/patches/patch_neighbours.h"

namespace lozenge {

/// The grids of all patches as one level of detail draws them, one after the other: patches of parts with a scale of
/// their own have fewer samples than others.
class PatchGrids {
 public:
  PatchGrids() = default;
  PatchGrids(const PatchLayout& layout, std::int32_t level) {
    samples_.reserve(layout.places.size());
    first_.reserve(layout.places.size() + 1);
    for (std::int32_t patch = 0; patch < layout.size(); ++patch) {
      samples_.push_back(layout.samples_of(patch, level));
      first_.push_back(first_.back() + static_cast<std::size_t>(samples_.back()) * samples_.back());
    }
  }

  std::int32_t patches() const { return static_cast<std::int32_t>(samples_.size()); }
  /// Of all patches, those that half patches don't have included.
  std::size_t size() const { return first_.back(); }
  std::int32_t samples(std::int32_t patch) const { return samples_[patch]; }
  std::size_t first(std::int32_t patch) const { return first_[patch]; }
  std::size_t index(std::int32_t patch, std::int32_t i, std::int32_t j) const {
    return first_[patch] + static_cast<std::size_t>(j) * samples_[patch] + i;
  }
  /// \pre index < size()
  PatchSample sample_at(std::size_t index) const {
    const auto next = std::upper_bound(first_.begin(), first_.end(), index);
    const auto patch = static_cast<std::int32_t>(next - first_.begin()) - 1;
    const auto in_patch = static_cast<std::int32_t>(index - first_[patch]);
    return {patch, in_patch % samples_[patch], in_patch / samples_[patch]};
  }

 private:
  std::vector<std::int32_t> samples_;     // [patch] a side
  std::vector<std::size_t> first_ = {0};  // [patch], and the end
};

}  // namespace lozenge
