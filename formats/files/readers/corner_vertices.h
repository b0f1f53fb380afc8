// Vertices made of what corners name of several lists.
#pragma once

#include <cstdint>
#include <vector>

namespace lozenge {

/// What a vertex is made of: an index into each list, -1 for nothing.
struct Combination {
  std::uint32_t position = 0;
  std::int32_t uv = -1;
  std::int32_t normal = -1;

  bool operator==(const Combination&) const = default;
};

/// Numbers combinations in the order in which they come.
class CornerVertices {
 public:
  explicit CornerVertices(std::size_t positions) : latest_(positions, kNone) {}

  /// The number of a combination: that of an equal one, or a new one. (Of very many at one position an equal one may be
  /// missed, so that a file made for it can't take forever; two equal vertices do no harm.)
  std::uint32_t number_of(const Combination& combination);

  /// [number]
  const std::vector<Combination>& all() const { return all_; }

  void clear();

 private:
  static constexpr std::uint32_t kNone = UINT32_MAX;

  std::vector<std::uint32_t> latest_;  ///< [position] the number of its latest combination
  std::vector<std::uint32_t> before_;  ///< [number] the combination before it at the same position
  std::vector<Combination> all_;
};

}  // namespace lozenge
