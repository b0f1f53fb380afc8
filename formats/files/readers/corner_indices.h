// Which element of a list of attributes each corner of a mesh names.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace lozenge {

/// Takes no memory as long as all corners name what they name of the positions, as in most files, or all name nothing.
class CornerIndices {
 public:
  using Triangles = std::vector<std::array<std::uint32_t, 3>>;

  /// The next triangle's. \param indices  -1 for none
  /// \param triangles  the positions' indices of all triangles so far, this one included
  void add(const std::array<std::int32_t, 3>& indices, const Triangles& triangles);

  bool are_none() const { return none_; }
  bool are_those_of_positions() const { return same_; }

  /// Of a corner (0..2) of a triangle, whose positions' indices are in `triangles`; -1 for none.
  std::int32_t of(std::size_t triangle, std::size_t corner, const Triangles& triangles) const {
    if (!own_.empty()) return own_[triangle][corner];
    return none_ ? -1 : static_cast<std::int32_t>(triangles[triangle][corner]);
  }

 private:
  bool none_ = true;
  bool same_ = true;
  std::vector<std::array<std::int32_t, 3>> own_;
};

}  // namespace lozenge
