#include "formats/files/readers/corner_indices.h"

namespace lozenge {

void CornerIndices::add(const std::array<std::int32_t, 3>& indices, const Triangles& triangles) {
  if (!own_.empty()) {
    own_.push_back(indices);
    return;
  }
  bool none = none_;
  bool same = same_;
  for (std::size_t k = 0; k < 3; ++k) {
    none = none && indices[k] < 0;
    same = same && indices[k] == static_cast<std::int32_t>(triangles.back()[k]);
  }
  if (!none && !same) {
    own_.resize(triangles.size() - 1);
    for (std::size_t t = 0; t < own_.size(); ++t) {
      for (std::size_t k = 0; k < 3; ++k) own_[t][k] = none_ ? -1 : static_cast<std::int32_t>(triangles[t][k]);
    }
    own_.push_back(indices);
  }
  none_ = none;
  same_ = same;
}

}  // namespace lozenge
