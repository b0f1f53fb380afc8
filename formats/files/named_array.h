// Arrays of numbers as programs that compute with a surface want them: NumPy's, for one.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace lozenge {

/// Truth values, a byte each: 0 or 1.
struct Truths {
  std::vector<std::uint8_t> bytes;
};

/// Numbers in rows; the last index runs fastest. A text has no index.
struct NamedArray {
  using Values = std::variant<std::vector<float>, std::vector<double>, std::vector<std::int32_t>, Truths, std::string>;

  std::string name;
  std::vector<std::int64_t> shape;
  Values values;
  /// Of [patch, row, column] and [patch, row, column, channel]: least and largest number of each channel, between which
  /// integers of a picture are spaced (`write_tile_pictures`); empty: it is no picture.
  std::vector<std::array<double, 2>> ranges = {};
};

}  // namespace lozenge
