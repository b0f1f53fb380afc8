// PLY: a header that lists elements and the types of their properties, then the values in that order, as text or as
// bytes. Everything is read as numbers by the header's types, and what isn't needed is dropped.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <memory>
#include <vector>

#include "formats/base/error.h"
#include "tools/bench/mesh_formats.h"
#include "tools/bench/text_scanner.h"

namespace lozenge::bench {
namespace {

enum class Type { kNone, kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat, kDouble };

struct Property {
  std::string name;
  Type count = Type::kNone;  ///< of the number of values, for a list
  Type type = Type::kNone;

  bool is_list() const { return count != Type::kNone; }
};

struct Element {
  std::string name;
  std::int64_t size = 0;
  std::vector<Property> properties;
};

enum class Encoding { kText, kLittleEndian, kBigEndian };

struct Header {
  Encoding encoding = Encoding::kText;
  std::vector<Element> elements;
};

Type type_of(std::string_view name) {
  struct Named {
    std::string_view name, longer;
    Type type;
  };
  static constexpr std::array kTypes{
      Named{"char", "int8", Type::kInt8},      Named{"uchar", "uint8", Type::kUint8},
      Named{"short", "int16", Type::kInt16},   Named{"ushort", "uint16", Type::kUint16},
      Named{"int", "int32", Type::kInt32},     Named{"uint", "uint32", Type::kUint32},
      Named{"float", "float32", Type::kFloat}, Named{"double", "float64", Type::kDouble}};
  for (const Named& t : kTypes) {
    if (name == t.name || name == t.longer) return t.type;
  }
  return Type::kNone;
}

// ---- The header

Property read_property(TextScanner& scanner) {
  Property property;
  std::string_view word = scanner.word_of_line();
  if (word == "list") {
    property.count = type_of(scanner.word_of_line());
    if (!property.is_list()) scanner.refuse("a list has a count of unknown type");
    word = scanner.word_of_line();
  }
  property.type = type_of(word);
  if (property.type == Type::kNone) scanner.refuse(fmt::format("there is no type '{:.40}'", word));
  property.name = scanner.word_of_line();
  return property;
}

Element read_element(TextScanner& scanner) {
  Element element;
  element.name = scanner.word_of_line();
  const std::string_view size = scanner.word_of_line();
  if (!parse_integer(size, element.size) || element.size < 0) {
    scanner.refuse(fmt::format("'{:.40}' is no number of elements", size));
  }
  return element;
}

Encoding read_encoding(TextScanner& scanner) {
  const std::string_view name = scanner.word_of_line();
  if (name == "ascii") return Encoding::kText;
  if (name == "binary_little_endian") return Encoding::kLittleEndian;
  if (name == "binary_big_endian") return Encoding::kBigEndian;
  scanner.refuse(fmt::format("there is no format '{:.40}'", name));
}

/// Leaves the scanner at the start of the data.
Header read_header(TextScanner& scanner) {
  if (scanner.word_of_line() != "ply") scanner.refuse("the file doesn't begin with ply");
  Header header;
  while (scanner.next_line()) {
    const std::string_view statement = scanner.word_of_line();
    if (statement == "format") {
      header.encoding = read_encoding(scanner);
    } else if (statement == "element") {
      header.elements.push_back(read_element(scanner));
    } else if (statement == "property") {
      if (header.elements.empty()) scanner.refuse("a property belongs to no element");
      header.elements.back().properties.push_back(read_property(scanner));
    } else if (statement == "end_header") {
      scanner.next_line();
      return header;
    }
  }
  scanner.refuse("the header has no end");
}

// ---- The data

/// Gives the values one after the other.
class Values {
 public:
  virtual ~Values() = default;
  virtual double next(Type type) = 0;
};

class TextValues : public Values {
 public:
  explicit TextValues(TextScanner& scanner) : scanner_(scanner) {}
  double next(Type) override { return scanner_.number("a value"); }

 private:
  TextScanner& scanner_;
};

class BinaryValues : public Values {
 public:
  BinaryValues(std::string_view bytes, bool swapped, std::string file)
      : bytes_(bytes), swapped_(swapped), file_(std::move(file)) {}

  double next(Type type) override {
    switch (type) {
      case Type::kInt8:
        return take<std::int8_t>();
      case Type::kUint8:
        return take<std::uint8_t>();
      case Type::kInt16:
        return take<std::int16_t>();
      case Type::kUint16:
        return take<std::uint16_t>();
      case Type::kInt32:
        return take<std::int32_t>();
      case Type::kUint32:
        return take<std::uint32_t>();
      case Type::kFloat:
        return static_cast<double>(take<float>());
      case Type::kDouble:
        return take<double>();
      case Type::kNone:
        break;
    }
    return 0;
  }

 private:
  template <typename T>
  T take() {
    if (bytes_.size() < sizeof(T)) {
      throw Error(ExitCode::kUnusableInput, file_ + ": ends before all elements that its header promises");
    }
    std::array<char, sizeof(T)> raw{};
    std::memcpy(raw.data(), bytes_.data(), sizeof(T));
    if (swapped_) std::reverse(raw.begin(), raw.end());
    bytes_.remove_prefix(sizeof(T));
    return std::bit_cast<T>(raw);
  }

  std::string_view bytes_;
  bool swapped_;
  std::string file_;
};

std::unique_ptr<Values> values_of(const Header& header, TextScanner& scanner, const std::string& file) {
  if (header.encoding == Encoding::kText) return std::make_unique<TextValues>(scanner);
  const bool swapped = (header.encoding == Encoding::kBigEndian) != (std::endian::native == std::endian::big);
  return std::make_unique<BinaryValues>(scanner.rest(), swapped, file);
}

[[noreturn]] void refuse_value(const std::string& file, const Property& property, double value) {
  throw Error(ExitCode::kUnusableInput, fmt::format("{}: {} is {}, which can't be", file, property.name, value));
}

/// As a whole number that a vertex index or a count may be.
std::int64_t whole(double value, const Property& property, const std::string& file) {
  if (!(std::abs(value) < 1e15) || value != std::floor(value)) refuse_value(file, property, value);
  return static_cast<std::int64_t>(value);
}

/// Reads all values of a list into `list`.
void read_list(Values& values, const Property& property, const std::string& file, std::vector<double>& list) {
  const double size = values.next(property.count);
  const std::int64_t count = whole(size, property, file);
  if (count < 0) refuse_value(file, property, size);
  list.clear();
  for (std::int64_t k = 0; k < count; ++k) list.push_back(values.next(property.type));
}

void read_vertices(const Element& element, Values& values, const std::string& file, PolygonMesh& mesh) {
  std::array<std::size_t, 3> places{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::size_t& place = places[axis];
    while (place < element.properties.size() && element.properties[place].name != std::string(1, "xyz"[axis])) ++place;
    if (place == element.properties.size() || element.properties[place].is_list()) {
      throw Error(ExitCode::kUnusableInput, file + ": its vertices have no x, y and z");
    }
  }
  std::vector<double> row(element.properties.size());
  std::vector<double> list;
  for (std::int64_t v = 0; v < element.size; ++v) {
    for (std::size_t p = 0; p < row.size(); ++p) {
      const Property& property = element.properties[p];
      if (property.is_list()) {
        read_list(values, property, file, list);
      } else {
        row[p] = values.next(property.type);
      }
    }
    mesh.add_vertex(row[places[0]], row[places[1]], row[places[2]]);
  }
}

bool is_corner_list(const Property& property) {
  return property.is_list() && (property.name == "vertex_indices" || property.name == "vertex_index");
}

/// Faces, and every other element, whose values are only passed.
/// \param polygons  gets the corners of each face, one after the other, their number before them
void read_others(const Element& element, Values& values, const std::string& file, std::vector<std::int64_t>& polygons) {
  if (element.properties.empty()) return;
  std::vector<double> list;
  for (std::int64_t e = 0; e < element.size; ++e) {
    for (const Property& property : element.properties) {
      if (!property.is_list()) {
        values.next(property.type);
        continue;
      }
      read_list(values, property, file, list);
      if (element.name != "face" || !is_corner_list(property)) continue;
      polygons.push_back(static_cast<std::int64_t>(list.size()));
      for (const double corner : list) polygons.push_back(whole(corner, property, file));
    }
  }
}

}  // namespace

void read_ply(std::string_view bytes, const std::string& file, PolygonMesh& mesh) {
  TextScanner scanner(bytes, file);
  const Header header = read_header(scanner);
  const std::unique_ptr<Values> values = values_of(header, scanner, file);
  std::vector<std::int64_t> polygons;
  for (const Element& element : header.elements) {
    if (element.name == "vertex") {
      read_vertices(element, *values, file, mesh);
    } else {
      read_others(element, *values, file, polygons);
    }
  }
  for (std::size_t at = 0; at < polygons.size(); at += polygons[at] + 1) {
    mesh.add_polygon({polygons.data() + at + 1, static_cast<std::size_t>(polygons[at])});
  }
}

}  // namespace lozenge::bench
