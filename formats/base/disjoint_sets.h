// Sets that grow by joining: what hangs together over edges, corners or triangles.
#pragma once

#include <algorithm>
#include <numeric>
#include <vector>

namespace lozenge {

/// The numbers 0 .. size - 1, each in a set of its own at first (a forest, with paths halved as they are walked).
template <typename Index>
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t size) : parents_(size) { std::iota(parents_.begin(), parents_.end(), Index{0}); }

  /// The lowest number of the set that `x` is in.
  Index root(Index x) {
    while (parents_[x] != x) x = parents_[x] = parents_[parents_[x]];
    return x;
  }

  /// Makes one set of two. \return whether they were two
  bool join(Index a, Index b) {
    a = root(a);
    b = root(b);
    if (a == b) return false;
    parents_[std::max(a, b)] = std::min(a, b);
    return true;
  }

 private:
  std::vector<Index> parents_;
};

}  // namespace lozenge
