#include "formats/files/readers/ply_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "formats/base/utf8.h"

namespace lozenge {

namespace {

/// Far more than any program writes.
constexpr std::int64_t kMostLines = 10'000;

struct NamedType {
  std::string_view name, longer;
  PlyType type;
  std::size_t size;
};

constexpr std::array kTypes{
    NamedType{"char", "int8", PlyType::kInt8, 1},      NamedType{"uchar", "uint8", PlyType::kUint8, 1},
    NamedType{"short", "int16", PlyType::kInt16, 2},   NamedType{"ushort", "uint16", PlyType::kUint16, 2},
    NamedType{"int", "int32", PlyType::kInt32, 4},     NamedType{"uint", "uint32", PlyType::kUint32, 4},
    NamedType{"float", "float32", PlyType::kFloat, 4}, NamedType{"double", "float64", PlyType::kDouble, 8}};

std::string shown(std::string_view word) { return valid_utf8(word.substr(0, 40)); }

PlyType read_type(std::string_view word, const TextScanner& scanner) {
  for (const NamedType& t : kTypes) {
    if (word == t.name || word == t.longer) return t.type;
  }
  scanner.refuse(fmt::format("there is no type '{}'", shown(word)));
}

PlyProperty read_property(TextScanner& scanner) {
  PlyProperty property;
  std::string_view word = scanner.word_of_line();
  if (word == "list") {
    property.count = read_type(scanner.word_of_line(), scanner);
    if (property.count == PlyType::kFloat || property.count == PlyType::kDouble) {
      scanner.refuse("a list's length is of a type that has fractions");
    }
    word = scanner.word_of_line();
  }
  property.type = read_type(word, scanner);
  property.name = in_lower_case(scanner.word_of_line());
  return property;
}

PlyElement read_element(TextScanner& scanner) {
  PlyElement element;
  element.name = in_lower_case(scanner.word_of_line());
  const std::string_view size = scanner.word_of_line();
  if (!parse_integer(size, element.count) || element.count < 0) {
    scanner.refuse(fmt::format("'{}' is no number of elements", shown(size)));
  }
  return element;
}

PlyEncoding read_encoding(TextScanner& scanner) {
  const std::string_view name = scanner.word_of_line();
  if (name == "ascii") return PlyEncoding::kText;
  if (name == "binary_little_endian") return PlyEncoding::kLittleEndian;
  if (name == "binary_big_endian") return PlyEncoding::kBigEndian;
  scanner.refuse(
      fmt::format("there is no format '{}'; it is ascii, binary_little_endian or binary_big_endian", shown(name)));
}

/// The bytes that an element takes at least.
std::uint64_t least_size(const PlyElement& element, PlyEncoding encoding) {
  std::uint64_t sum = 0;
  for (const PlyProperty& p : element.properties) {
    if (encoding == PlyEncoding::kText) {
      sum += 2;  // a digit and what parts it from the next one
    } else {
      sum += size_of(p.is_list() ? p.count : p.type);
    }
  }
  return sum;
}

/// Before memory is taken for what the header promises.
void require_bytes_for(const PlyHeader& header, TextScanner& scanner) {
  // The last number of a text may end with the file.
  std::uint64_t left = scanner.window().left() + (header.encoding == PlyEncoding::kText ? 1 : 0);
  for (const PlyElement& element : header.elements) {
    const std::uint64_t size = least_size(element, header.encoding);
    if (size == 0) continue;
    if (static_cast<std::uint64_t>(element.count) > left / size) {
      scanner.refuse(
          fmt::format("the header promises {} of the element '{}', more than the {} bytes after it can hold; "
                      "is the file whole?",
                      element.count, shown(element.name), scanner.window().left()));
    }
    left -= static_cast<std::uint64_t>(element.count) * size;
  }
}

/// Which end of a line the file's first line has: bytes follow the header's last one at once, and may look like
/// another.
std::string line_end_of(TextScanner& scanner) {
  const std::string_view text = scanner.window().ahead(2);
  if (text.starts_with("\r\n")) return "\r\n";
  return std::string(text.substr(0, 1));
}

}  // namespace

std::size_t size_of(PlyType type) {
  for (const NamedType& t : kTypes) {
    if (type == t.type) return t.size;
  }
  return 0;
}

int PlyElement::find(std::initializer_list<std::string_view> names, bool list) const {
  const auto at = std::find_if(properties.begin(), properties.end(), [&](const PlyProperty& p) {
    return p.is_list() == list && std::find(names.begin(), names.end(), p.name) != names.end();
  });
  return at == properties.end() ? -1 : static_cast<int>(at - properties.begin());
}

PlyHeader read_ply_header(TextScanner& scanner) {
  if (scanner.word_of_line() != "ply") scanner.refuse("the file doesn't begin with 'ply'");
  const std::string line_end = line_end_of(scanner);
  PlyHeader header;
  bool has_format = false;
  while (scanner.next_line()) {
    const std::string_view statement = scanner.word_of_line();
    if (statement == "format") {
      header.encoding = read_encoding(scanner);
      has_format = true;
    } else if (statement == "element") {
      header.elements.push_back(read_element(scanner));
    } else if (statement == "property") {
      if (header.elements.empty()) scanner.refuse("a property belongs to no element");
      header.elements.back().properties.push_back(read_property(scanner));
    } else if (statement == "end_header") {
      if (!has_format) scanner.refuse("the header doesn't say which format the data have");
      if (header.encoding != PlyEncoding::kText) {
        if (!scanner.window().ahead(line_end.size()).starts_with(line_end)) {
          scanner.refuse("the header's last line ends otherwise than its first; was the file changed by a transfer?");
        }
        scanner.window().skip(line_end.size());
      } else {
        scanner.next_line();
      }
      require_bytes_for(header, scanner);
      return header;
    } else if (statement != "comment" && statement != "obj_info" && !statement.empty()) {
      scanner.refuse(fmt::format("'{}' is nothing that a header may say", shown(statement)));
    }
    if (scanner.line() > kMostLines) scanner.refuse("the header has no end");
  }
  scanner.refuse("the header has no end");
}

}  // namespace lozenge
