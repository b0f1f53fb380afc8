// What is known of a file before somebody reads it.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace lozenge {

/// How a file begins.
struct InputStart {
  std::string bytes;       ///< the first of them, or all
  std::uint64_t size = 0;  ///< of the whole file
};

/// Whether a file is of a format.
enum class Likeness {
  kNone,
  kIfNamedSo,  ///< nothing speaks against it: where no other format is sure, the name's ending decides
  kSure,
};

/// A text without the mark (U+FEFF) that some editors put before UTF-8.
std::string_view without_mark(std::string_view text);

/// The next word of a text that begins at `at`, which moves behind it. White space and comments from `#` to the end of
/// the line are passed; empty at the end.
std::string_view next_word(std::string_view text, std::size_t& at);

/// `word` in lower case, as far as its letters are ASCII.
std::string in_lower_case(std::string_view word);

}  // namespace lozenge
