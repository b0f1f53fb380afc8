#include "formats/files/readers/input_start.h"

#include <algorithm>

namespace lozenge {

std::string_view without_mark(std::string_view text) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  return text;
}

std::string_view next_word(std::string_view text, std::size_t& at) {
  constexpr std::string_view kBlanks = " \t\r\n\v\f";
  at = std::min(text.find_first_not_of(kBlanks, at), text.size());
  while (at < text.size() && text[at] == '#') {
    at = std::min(text.find_first_of("\r\n", at), text.size());
    at = std::min(text.find_first_not_of(kBlanks, at), text.size());
  }
  const std::size_t start = at;
  at = std::min(text.find_first_of(" \t\r\n\v\f#", at), text.size());
  return text.substr(start, at - start);
}

std::string in_lower_case(std::string_view word) {
  std::string lower(word);
  for (char& c : lower) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return lower;
}

}  // namespace lozenge
