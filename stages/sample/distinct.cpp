// All places are sorted by their bits. Of equal ones all but the first move to the nearest free position; each takes
// every name that it has along with it.
#include "stages/sample/distinct.h"

#include <algorithm>
#include <array>
#include <bit>
#include <set>

#include "formats/base/parallel.h"

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
  for (std::int32_t patch = 0; patch < set.size(); ++patch) {
    const std::int32_t last = neighbours.last(patch);
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
  sort_on_all_threads(owners);
  return owners;
}

/// The float `steps` floats further from zero, or nearer where there are no more.
float stepped(float x, std::uint32_t steps) {
  const auto bits = std::bit_cast<std::uint32_t>(x);
  const bool fits = (bits & 0x7FFFFFFF) + steps < 0x7F800000;
  return std::bit_cast<float>(fits ? bits + steps : bits - steps);
}

/// Position number `n` of those around p, 0 being p itself: its bits, dealt to the three axes in turn, are the steps
/// along each, so that the first n fill a cube and stay near.
Vec3f nudged(const Vec3f& p, std::uint32_t n) {
  std::array<std::uint32_t, 3> steps{};
  for (int bit = 0; bit < 32; ++bit) steps[bit % 3] |= ((n >> bit) & 1) << (bit / 3);
  return {stepped(p.x, steps[0]), stepped(p.y, steps[1]), stepped(p.z, steps[2])};
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
  const std::vector<Placed> owners = sorted_owners(set, neighbours);
  std::set<Key> taken;  // by samples that were moved
  const auto is_free = [&](const Key& key) {
    const auto at = std::lower_bound(owners.begin(), owners.end(), Placed{key, 0});
    return (at == owners.end() || at->key != key) && !taken.contains(key);
  };
  std::uint32_t tried = 0;  // of the positions around the current one
  for (std::size_t n = 1; n < owners.size(); ++n) {
    if (owners[n].key != owners[n - 1].key) {
      tried = 0;
      continue;
    }
    const Vec3f here = set.positions[owners[n].index];
    Vec3f moved = here;
    while (!is_free(key_of(moved))) moved = nudged(here, ++tried);
    taken.insert(key_of(moved));
    const PatchSample owner = set.grids.sample_at(owners[n].index);
    for (const PatchSample& name : neighbours.names(owner)) {
      set.positions[set.index(name.patch, name.i, name.j)] = moved;
    }
  }
  return static_cast<std::int64_t>(taken.size());
}

}  // namespace lozenge
