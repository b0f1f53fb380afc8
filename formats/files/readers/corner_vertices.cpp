#include "formats/files/readers/corner_vertices.h"

namespace lozenge {

namespace {

/// A vertex of a usual mesh has one to six.
constexpr int kMostCompared = 64;

}  // namespace

std::uint32_t CornerVertices::number_of(const Combination& combination) {
  std::uint32_t& latest = latest_[combination.position];
  int compared = 0;
  for (std::uint32_t n = latest; n != kNone && compared < kMostCompared; n = before_[n], ++compared) {
    if (all_[n] == combination) return n;
  }
  before_.push_back(latest);
  latest = static_cast<std::uint32_t>(all_.size());
  all_.push_back(combination);
  return latest;
}

void CornerVertices::clear() {
  for (const Combination& combination : all_) latest_[combination.position] = kNone;
  all_.clear();
  before_.clear();
}

}  // namespace lozenge
