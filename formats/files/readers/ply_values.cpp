#include "formats/files/readers/ply_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>

#include "formats/base/error.h"

namespace lozenge {

namespace {

class TextValues final : public PlyValues {
 public:
  explicit TextValues(TextScanner& scanner) : scanner_(scanner) {}

  double next(const PlyProperty& property) override {
    return property.type == PlyType::kFloat ? scanner_.float_number(name_of(property))
                                            : scanner_.number(name_of(property));
  }
  std::int64_t next_count(const PlyProperty& property) override { return scanner_.count(name_of(property), 2); }
  std::int64_t place() override { return scanner_.line_of_next_word(); }
  const char* unit() const override { return "line"; }
  void refuse(const std::string& problem) override { scanner_.refuse(problem); }

 private:
  static const char* name_of(const PlyProperty& property) { return property.name.c_str(); }

  TextScanner& scanner_;
};

template <typename T>
double value_of(const char* bytes, bool swapped) {
  std::array<char, sizeof(T)> raw{};
  std::memcpy(raw.data(), bytes, sizeof(T));
  if (swapped) std::reverse(raw.begin(), raw.end());
  return static_cast<double>(std::bit_cast<T>(raw));
}

double value_of(PlyType type, const char* bytes, bool swapped) {
  switch (type) {
    case PlyType::kInt8:
      return value_of<std::int8_t>(bytes, swapped);
    case PlyType::kUint8:
      return value_of<std::uint8_t>(bytes, swapped);
    case PlyType::kInt16:
      return value_of<std::int16_t>(bytes, swapped);
    case PlyType::kUint16:
      return value_of<std::uint16_t>(bytes, swapped);
    case PlyType::kInt32:
      return value_of<std::int32_t>(bytes, swapped);
    case PlyType::kUint32:
      return value_of<std::uint32_t>(bytes, swapped);
    case PlyType::kFloat:
      return value_of<float>(bytes, swapped);
    case PlyType::kDouble:
      return value_of<double>(bytes, swapped);
    case PlyType::kNone:
      break;
  }
  return 0;
}

class BinaryValues final : public PlyValues {
 public:
  BinaryValues(InputWindow& window, bool swapped) : window_(window), swapped_(swapped) {}

  double next(const PlyProperty& property) override { return take(property.type); }

  std::int64_t next_count(const PlyProperty& property) override {
    const auto count = static_cast<std::int64_t>(take(property.count));
    if (count < 0) refuse(fmt::format("the length of {} is {}, less than nothing", property.name, count));
    if (static_cast<std::uint64_t>(count) > window_.left() / size_of(property.type)) {
      refuse(fmt::format("{} has {} values, more than the {} bytes that are left of the file can hold; is it whole?",
                         property.name, count, window_.left()));
    }
    return count;
  }

  std::int64_t place() override { return static_cast<std::int64_t>(window_.offset()); }
  const char* unit() const override { return "byte"; }
  void refuse(const std::string& problem) override {
    throw Error(ExitCode::kUnusableInput, fmt::format("{}: byte {}: {}", window_.what(), window_.offset(), problem));
  }

 private:
  double take(PlyType type) {
    const std::size_t size = size_of(type);
    const std::string_view bytes = window_.ahead(size);
    if (bytes.size() < size) refuse("the file ends before all elements that its header promises; is it whole?");
    window_.skip(size);
    return value_of(type, bytes.data(), swapped_);
  }

  InputWindow& window_;
  bool swapped_;
};

}  // namespace

std::unique_ptr<PlyValues> ply_values(TextScanner& scanner, PlyEncoding encoding) {
  if (encoding == PlyEncoding::kText) return std::make_unique<TextValues>(scanner);
  const bool swapped = (encoding == PlyEncoding::kBigEndian) != (std::endian::native == std::endian::big);
  return std::make_unique<BinaryValues>(scanner.window(), swapped);
}

}  // namespace lozenge
