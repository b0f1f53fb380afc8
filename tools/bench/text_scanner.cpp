#include "tools/bench/text_scanner.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "formats/base/error.h"

namespace lozenge::bench {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f'; }

template <typename Value>
bool parse(std::string_view word, Value& value) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  const char* end = word.data() + word.size();
  const auto [stop, error] = std::from_chars(word.data(), end, value);
  return error == std::errc() && stop == end;
}

}  // namespace

bool parse_number(std::string_view word, double& value) { return parse(word, value); }
bool parse_integer(std::string_view word, std::int64_t& value) { return parse(word, value); }

void TextScanner::skip_blanks() {
  while (at_ < text_.size() && is_blank(text_[at_])) ++at_;
  if (at_ < text_.size() && text_[at_] == '#') at_ = std::min(text_.find('\n', at_), text_.size());
}

std::string_view TextScanner::word_of_line() {
  skip_blanks();
  const std::size_t start = at_;
  while (at_ < text_.size() && !is_blank(text_[at_]) && text_[at_] != '\n' && text_[at_] != '#') ++at_;
  return text_.substr(start, at_ - start);
}

bool TextScanner::next_line() {
  const std::size_t end = text_.find('\n', at_);
  if (end == std::string_view::npos) {
    at_ = text_.size();
    return false;
  }
  at_ = end + 1;
  ++line_;
  return at_ < text_.size();
}

std::string_view TextScanner::word() {
  std::string_view found = word_of_line();
  while (found.empty() && next_line()) found = word_of_line();
  return found;
}

double TextScanner::number(const char* what) {
  const std::string_view text = word();
  double value = 0;
  if (!parse_number(text, value)) {
    refuse(text.empty() ? fmt::format("the file ends where {} is expected", what)
                        : fmt::format("{} is '{:.40}', which is no number", what, text));
  }
  return value;
}

std::int64_t TextScanner::integer(const char* what) {
  const std::string_view text = word();
  std::int64_t value = 0;
  if (!parse_integer(text, value)) {
    refuse(text.empty() ? fmt::format("the file ends where {} is expected", what)
                        : fmt::format("{} is '{:.40}', which is no whole number", what, text));
  }
  return value;
}

void TextScanner::refuse(const std::string& problem) const {
  throw Error(ExitCode::kUnusableInput, fmt::format("{}: line {}: {}", file_, line_, problem));
}

}  // namespace lozenge::bench
