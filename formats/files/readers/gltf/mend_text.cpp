#include "formats/files/readers/gltf/mend_text.h"

#include <cctype>
#include <optional>
#include <string_view>

#include "formats/base/utf8.h"

namespace lozenge {

namespace {

constexpr std::size_t kEscape = 6;  // \uD83D

/// The number of an escape \uXXXX at this place.
std::optional<unsigned> escape_at(const std::string& text, std::size_t at) {
  if (at + kEscape > text.size() || text[at] != '\\' || text[at + 1] != 'u') return std::nullopt;
  for (std::size_t i = at + 2; i < at + kEscape; ++i) {
    if (std::isxdigit(static_cast<unsigned char>(text[i])) == 0) return std::nullopt;
  }
  return static_cast<unsigned>(std::stoul(text.substr(at + 2, 4), nullptr, 16));
}

bool is_first_half(unsigned code) { return code >= 0xD800 && code < 0xDC00; }
bool is_second_half(unsigned code) { return code >= 0xDC00 && code < 0xE000; }

/// \return whether there were any
bool replace_half_pairs(std::string& text) {
  bool found = false;
  for (std::size_t i = text.find('\\'); i != std::string::npos && i + 1 < text.size(); i = text.find('\\', i)) {
    const std::optional<unsigned> code = escape_at(text, i);
    if (!code) {
      i += 2;
      continue;
    }
    const std::optional<unsigned> next = escape_at(text, i + kEscape);
    if (is_first_half(*code) && next && is_second_half(*next)) {
      i += 2 * kEscape;
      continue;
    }
    if (is_first_half(*code) || is_second_half(*code)) {
      text.replace(i, kEscape, "\\uFFFD");
      found = true;
    }
    i += kEscape;
  }
  return found;
}

}  // namespace

void mend_gltf_text(std::string& text, const std::string& name, Deviations& deviations) {
  const std::size_t end = text.find_last_not_of(std::string_view("\0 \t\r\n", 5));
  if (end != std::string::npos && text.find('\0', end) != std::string::npos) {
    text.resize(end + 1);
    deviations.add(Deviation::kText, name + ": zeros follow its JSON");
  }
  if (replace_half_pairs(text)) deviations.add(Deviation::kText, name + ": its JSON holds half a surrogate pair");
  if (std::string valid = valid_utf8(text); valid != text) {
    text = std::move(valid);
    deviations.add(Deviation::kText, name + ": its JSON holds bytes that are no UTF-8");
  }
}

}  // namespace lozenge
