#include "formats/files/readers/text_scanner.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstring>

#include "formats/base/error.h"
#include "formats/base/utf8.h"

namespace lozenge {

namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }
bool ends_line(char c) { return c == '\n' || c == '\r'; }

std::string_view without_plus(std::string_view word) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  return word;
}

template <typename Value>
std::errc parse(std::string_view word, Value& value) {
  const char* end = word.data() + word.size();
  const auto [stop, error] = std::from_chars(word.data(), end, value);
  return error == std::errc() && stop != end ? std::errc::invalid_argument : error;
}

}  // namespace

bool parse_number(std::string_view word, double& value) { return parse(without_plus(word), value) == std::errc(); }
bool parse_integer(std::string_view word, std::int64_t& value) {
  return parse(without_plus(word), value) == std::errc();
}

bool parse_float(std::string_view word, float& value) {
  const std::errc error = parse(without_plus(word), value);
  if (error != std::errc::result_out_of_range) return error == std::errc();
  // Too large, or so small that it is zero.
  double wide = 0;
  if (!parse_number(word, wide)) return false;
  value = static_cast<float>(wide);
  return true;
}

TextScanner::TextScanner(InputFile file) : window_(std::move(file)) {
  const std::string_view start = window_.ahead(3);
  window_.skip(start.size() - without_mark(start).size());
}

void TextScanner::skip_blanks() {
  bool in_comment = false;
  for (;;) {
    const std::string_view text = window_.ahead(1);
    if (text.empty()) return;
    std::size_t k = 0;
    while (k < text.size() && !ends_line(text[k]) && (in_comment || is_blank(text[k]) || text[k] == '#')) {
      in_comment = in_comment || text[k] == '#';
      ++k;
    }
    window_.skip(k);
    if (k < text.size()) return;
  }
}

std::string_view TextScanner::word_of_line() {
  skip_blanks();
  const std::string_view text = window_.ahead(kLongestWord + 1);
  std::size_t k = 0;
  while (k < text.size() && !is_blank(text[k]) && !ends_line(text[k]) && text[k] != '#') {
    if (++k > kLongestWord) refuse(fmt::format("has a word of more than {} characters; is it text?", kLongestWord));
  }
  window_.skip(k);
  return text.substr(0, k);
}

std::string TextScanner::rest_of_line() {
  const std::string_view text = window_.ahead(kLongestWord);
  std::size_t k = 0;
  while (k < std::min(text.size(), kLongestWord) && !ends_line(text[k])) ++k;
  std::size_t start = 0;
  while (start < k && is_blank(text[start])) ++start;
  std::size_t end = k;
  while (end > start && is_blank(text[end - 1])) --end;
  window_.skip(k);
  return std::string(text.substr(start, end - start));
}

bool TextScanner::next_line() {
  for (;;) {
    const std::string_view text = window_.ahead(1);
    if (text.empty()) return false;
    std::size_t k = 0;
    while (k < text.size() && !ends_line(text[k])) ++k;
    window_.skip(k);
    if (k < text.size()) break;
  }
  const bool returns = window_.ahead(1)[0] == '\r';
  window_.skip(1);
  if (returns && window_.ahead(1).starts_with('\n')) window_.skip(1);
  ++line_;
  return window_.left() > 0;
}

std::int64_t TextScanner::line_of_next_word() {
  do {
    skip_blanks();
    const std::string_view text = window_.ahead(1);
    if (text.empty() || !ends_line(text[0])) break;
  } while (next_line());
  return line_;
}

std::string_view TextScanner::word() {
  std::string_view found = word_of_line();
  while (found.empty() && next_line()) found = word_of_line();
  return found;
}

void TextScanner::refuse_number(std::string_view text, const char* what, const char* kind) const {
  refuse(text.empty() ? fmt::format("the file ends where {} is expected", what)
                      : fmt::format("{} is '{}', which is no {}", what, valid_utf8(text.substr(0, 40)), kind));
}

double TextScanner::number(const char* what) {
  const std::string_view text = word();
  double value = 0;
  if (!parse_number(text, value)) refuse_number(text, what, "number");
  return value;
}

float TextScanner::float_number(const char* what) {
  const std::string_view text = word();
  float value = 0;
  if (!parse_float(text, value)) refuse_number(text, what, "number");
  return value;
}

std::int64_t TextScanner::integer(const char* what) {
  const std::string_view text = word();
  std::int64_t value = 0;
  if (!parse_integer(text, value)) refuse_number(text, what, "whole number");
  return value;
}

std::int64_t TextScanner::as_count(std::int64_t count, const char* what, std::uint64_t bytes) const {
  if (count < 0) refuse(fmt::format("{} is {}, less than nothing", what, count));
  // The last one may end with the file instead of a blank.
  if (static_cast<std::uint64_t>(count) > (window_.left() + 1) / bytes) {
    refuse(fmt::format("{} is {}, more than the {} bytes that are left of the file can hold; is it whole?", what, count,
                       window_.left()));
  }
  return count;
}

void TextScanner::refuse(const std::string& problem) const {
  throw Error(ExitCode::kUnusableInput, fmt::format("{}: line {}: {}", window_.what(), line_, problem));
}

}  // namespace lozenge
