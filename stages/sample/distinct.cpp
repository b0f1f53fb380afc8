#include "stages/sample/distinct.h"

#include <tbb/parallel_sort.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <set>

namespace lozenge {

namespace {

using Key = std::array<std::uint32_t, 3>;

Key key_of(const Vec3f& p) {
  return {std::bit_cast<std::uint32_t>(p.x), std::bit_cast<std::uint32_t>(p.y), std::bit_cast<std::uint32_t>(p.z)};
}

struct Placed {
  Key key;
  std::int32_t index;  ///< in the arrays of the set
  auto operator<=>(const Placed&) const = default;
};

/// Every place once, under its owner's index, sorted by position, then index.
std::vector<Placed> sorted_owners(const PatchSet& set, const PatchNeighbours& neighbours) {
  std::vector<Placed> owners;
  owners.reserve(set.positions.size());
  const std::int32_t last = set.samples - 1;
  for (std::int32_t patch = 0; patch < set.size(); ++patch) {
    for (std::int32_t j = 0; j <= last; ++j) {
      for (std::int32_t i = 0; i <= last; ++i) {
        const PatchSample here{patch, i, j};
        if (!neighbours.exists(here)) continue;
        const bool on_border = i == 0 || j == 0 || i == last || j == last;
        if (on_border && !(owner_of(neighbours, here) == here)) continue;
        const std::size_t index = set.index(patch, i, j);
        owners.push_back({key_of(set.positions[index]), static_cast<std::int32_t>(index)});
      }
    }
  }
  tbb::parallel_sort(owners.begin(), owners.end());
  return owners;
}

/// The position `steps` floats further along one axis; axes take turns, so that large steps stay short.
Vec3f nudged(Vec3f p, int steps) {
  float& x = p[steps % 3];
  for (int n = 0; n <= steps / 3; ++n) {
    // Not towards -0: leaving zero goes up.
    x = std::nextafter(x, x < 0 ? -std::numeric_limits<float>::max() : std::numeric_limits<float>::max());
  }
  return p;
}

}  // namespace

PatchSample owner_of(const PatchNeighbours& neighbours, const PatchSample& sample) {
  const std::vector<PatchSample> names = neighbours.names(sample);
  return *std::min_element(names.begin(), names.end(), [](const PatchSample& a, const PatchSample& b) {
    return std::array{a.patch, a.j, a.i} < std::array{b.patch, b.j, b.i};
  });
}

std::int64_t make_distinct(PatchSet& set) {
  const PatchNeighbours neighbours(set.samples, set.adjacency);
  const std::vector<Placed> owners = sorted_owners(set, neighbours);
  std::set<Key> taken;  // by samples that were moved
  const auto is_free = [&](const Key& key) {
    const auto at = std::lower_bound(owners.begin(), owners.end(), Placed{key, 0});
    return (at == owners.end() || at->key != key) && !taken.contains(key);
  };
  for (std::size_t n = 1; n < owners.size(); ++n) {
    if (owners[n].key != owners[n - 1].key) continue;
    Vec3f moved = set.positions[owners[n].index];
    for (int steps = 0; !is_free(key_of(moved)); ++steps) moved = nudged(set.positions[owners[n].index], steps);
    taken.insert(key_of(moved));
    const std::int32_t in_patch = owners[n].index % (set.samples * set.samples);
    const PatchSample owner{owners[n].index / (set.samples * set.samples), in_patch % set.samples,
                            in_patch / set.samples};
    for (const PatchSample& name : neighbours.names(owner)) {
      set.positions[set.index(name.patch, name.i, name.j)] = moved;
    }
  }
  return static_cast<std::int64_t>(taken.size());
}

}  // namespace lozenge
