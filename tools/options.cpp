#include "tools/options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <charconv>
#include <filesystem>

#include "formats/base/atomic_file.h"

namespace lozenge {
namespace {

int parse_int(std::string_view text, const std::string& option, const std::string& whole) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) {
    throw CLI::ValidationError(option, fmt::format("'{}' is no range; write 100..200, or one number", whole));
  }
  return value;
}

/// An empty text where it is a valid N, as CLI11 wants it.
std::string complaint_about_samples(const std::string& text) {
  int n = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), n);
  const bool valid =
      error == std::errc() && end == text.data() + text.size() && n >= 2 && n <= 1025 && ((n - 1) & (n - 2)) == 0;
  return valid ? "" : fmt::format("'{}' is not 2^k + 1: choose 2, 3, 5, 9, 17, 33, ... or 1025", text);
}

}  // namespace

IntRange parse_range(const std::string& option, const std::string& text) {
  const std::size_t dots = text.find("..");
  IntRange range;
  range.first = parse_int(std::string_view(text).substr(0, dots), option, text);
  range.last =
      dots == std::string::npos ? range.first : parse_int(std::string_view(text).substr(dots + 2), option, text);
  if (range.first > range.last) throw CLI::ValidationError(option, fmt::format("'{}' runs backwards", text));
  return range;
}

std::string file_name(const std::string& path) { return std::filesystem::path(path).filename().string(); }

void require_writable(const std::string& path) {
  if (!path.empty()) AtomicFile probe(path);
}

CLI::Option* add_input(CLI::App& command, const std::string& name, std::string& file, const std::string& what) {
  return command.add_option(name, file, what)->required()->type_name("");
}

CLI::Option* add_output(CLI::App& command, std::string& path, const std::string& what) {
  return command.add_option("-o,--output", path, what)->required()->type_name("PATH");
}

CLI::Option* add_samples(CLI::App& command, const std::string& name, int& samples, const std::string& what) {
  return command.add_option(name, samples, what)->check(CLI::Validator(complaint_about_samples, ""))->type_name("N");
}

}  // namespace lozenge
