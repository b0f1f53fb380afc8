// What several commands do with their options.
#pragma once

#include <string>

namespace lozenge {

/// "100..200", or one number for both.
struct IntRange {
  int first = 0;
  int last = 0;
};

/// \throws Error(kUsage) where the text is no range, or runs backwards
IntRange parse_range(const std::string& text);

/// The name of a file without its folder, as messages call it.
std::string file_name(const std::string& path);

/// Finds out before the work whether its output can be written; an empty path is none.
/// \throws Error(kUsage) naming the path and the reason
void require_writable(const std::string& path);

}  // namespace lozenge
