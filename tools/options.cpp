#include "tools/options.h"

#include <fmt/format.h>

#include <charconv>
#include <filesystem>

#include "formats/base/atomic_file.h"
#include "formats/base/error.h"

namespace lozenge {
namespace {

int parse_int(std::string_view text, const std::string& whole) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) {
    throw Error(ExitCode::kUsage, fmt::format("'{}' is no range; write 100..200, or one number", whole));
  }
  return value;
}

}  // namespace

IntRange parse_range(const std::string& text) {
  const std::size_t dots = text.find("..");
  IntRange range;
  range.first = parse_int(std::string_view(text).substr(0, dots), text);
  range.last = dots == std::string::npos ? range.first : parse_int(std::string_view(text).substr(dots + 2), text);
  if (range.first > range.last) throw Error(ExitCode::kUsage, fmt::format("'{}' runs backwards", text));
  return range;
}

std::string file_name(const std::string& path) { return std::filesystem::path(path).filename().string(); }

void require_writable(const std::string& path) {
  if (!path.empty()) AtomicFile probe(path);
}

}  // namespace lozenge
