// The header of a PLY: which elements come, how many of each, and which properties of which types each has.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "formats/files/readers/text_scanner.h"

namespace lozenge {

enum class PlyType : std::uint8_t { kNone, kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat, kDouble };

/// In bytes.
std::size_t size_of(PlyType type);

struct PlyProperty {
  std::string name;
  PlyType count = PlyType::kNone;  ///< of the number of values, for a list
  PlyType type = PlyType::kNone;

  bool is_list() const { return count != PlyType::kNone; }
};

struct PlyElement {
  std::string name;
  std::int64_t count = 0;
  std::vector<PlyProperty> properties;

  /// The number of the first property that has one of these names, and is a list or not; -1 where there is none.
  int find(std::initializer_list<std::string_view> names, bool list) const;
};

enum class PlyEncoding : std::uint8_t { kText, kLittleEndian, kBigEndian };

struct PlyHeader {
  PlyEncoding encoding = PlyEncoding::kText;
  std::vector<PlyElement> elements;
};

/// Leaves the scanner at the start of the data.
/// \throws Error(kUnusableInput) naming the line where the header is broken, or promises more elements than the file
///         has bytes for
PlyHeader read_ply_header(TextScanner& scanner);

}  // namespace lozenge
