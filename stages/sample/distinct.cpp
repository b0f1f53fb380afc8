// Each place is moved once, under its owner's name, and takes every name that it has along with it.
#include "stages/sample/distinct.h"

#include <algorithm>
#include <array>
#include <vector>

#include "formats/base/parallel.h"
#include "formats/surface/distinct_positions.h"

namespace lozenge {

namespace {

/// Every place once, under its owner's index, sorted by position, then index.
std::vector<NumberedPosition> sorted_owners(const PatchSet& set, const PatchNeighbours& neighbours) {
  std::vector<NumberedPosition> owners;
  owners.reserve(set.positions.size());
  for (std::int32_t patch = 0; patch < set.size(); ++patch) {
    const std::int32_t last = neighbours.last(patch);
    for (std::int32_t j = 0; j <= last; ++j) {
      for (std::int32_t i = 0; i <= last; ++i) {
        const PatchSample here{patch, i, j};
        if (!neighbours.exists(here)) continue;
        const bool on_border = i == 0 || j == 0 || i == last || j == last;
        if (on_border && !(owner_of(neighbours, here) == here)) continue;
        const std::size_t index = set.index(patch, i, j);
        owners.push_back(numbered(set.positions[index], static_cast<std::int32_t>(index)));
      }
    }
  }
  sort_on_all_threads(owners);
  return owners;
}

}  // namespace

PatchSample owner_of(const PatchNeighbours& neighbours, const PatchSample& sample) {
  const std::vector<PatchSample> names = neighbours.names(sample);
  return *std::min_element(names.begin(), names.end(), [](const PatchSample& a, const PatchSample& b) {
    return std::array{a.patch, a.j, a.i} < std::array{b.patch, b.j, b.i};
  });
}

std::int64_t make_distinct(PatchSet& set) {
  const PatchNeighbours neighbours(set.layout);
  const std::vector<MovedPosition> moves = moved_apart(sorted_owners(set, neighbours));
  for (const auto& [index, moved] : moves) {
    const PatchSample owner = set.grids.sample_at(index);
    for (const PatchSample& name : neighbours.names(owner)) {
      set.positions[set.index(name.patch, name.i, name.j)] = moved;
    }
  }
  return static_cast<std::int64_t>(moves.size());
}

}  // namespace lozenge
