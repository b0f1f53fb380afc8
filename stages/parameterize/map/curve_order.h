// Orders in which what is near in space is near in memory.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "formats/base/parallel.h"
#include "formats/surface/source_mesh.h"

namespace lozenge {

/// Interleaves the low 32 / N bits of N numbers: near points get near numbers (Morton's curve).
template <std::size_t N>
std::uint32_t interleaved(const std::array<std::uint32_t, N>& cell) {
  std::uint32_t code = 0;
  for (int bit = 32 / N - 1; bit >= 0; --bit) {
    for (const std::uint32_t c : cell) code = (code << 1) | ((c >> bit) & 1);
  }
  return code;
}

/// The numbers that the keys stand with, by ascending key; the same on any number of threads, for no two pairs are.
template <typename Key>
std::vector<std::int32_t> numbers_by_key(std::vector<std::pair<Key, std::int32_t>> pairs) {
  sort_on_all_threads(pairs);
  std::vector<std::int32_t> numbers(pairs.size());
  std::transform(pairs.begin(), pairs.end(), numbers.begin(), [](const auto& pair) { return pair.second; });
  return numbers;
}

/// Where points lie on a curve through a box that holds them.
class SpaceCurve {
 public:
  explicit SpaceCurve(const Bounds& bounds);
  std::uint32_t place_of(const Vec3f& p) const;

 private:
  Vec3f low_;
  float longest_;  ///< side of the box
};

/// The triangles along such a curve, by their first corners.
std::vector<TriangleId> triangles_along_curve(const SourceMesh& mesh);

}  // namespace lozenge
