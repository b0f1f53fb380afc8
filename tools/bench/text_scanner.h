// Words and numbers of a text file, one after the other, with the line that they are in for messages.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace lozenge::bench {

/// Goes through a text once. Words are separated by white space; `#` begins a comment that ends with the line.
class TextScanner {
 public:
  /// Keeps a view of `text`. \param file  begins every message
  TextScanner(std::string_view text, std::string file) : text_(text), file_(std::move(file)) {}

  /// The next word, on whatever line; empty at the end of the text.
  std::string_view word();
  /// The next word of this line; empty where it has no more.
  std::string_view word_of_line();
  /// Goes to the start of the next line. \return false where there is none
  bool next_line();

  /// The next word as a number; `what` names it in messages.
  /// \throws Error(kUnusableInput) where it is none, or the text has ended
  double number(const char* what);
  std::int64_t integer(const char* what);

  /// \throws Error(kUnusableInput) "FILE: line N: PROBLEM"
  [[noreturn]] void refuse(const std::string& problem) const;

  /// What is left of the text.
  std::string_view rest() const { return text_.substr(at_); }

 private:
  void skip_blanks();

  std::string_view text_;
  std::string file_;
  std::size_t at_ = 0;
  std::int64_t line_ = 1;
};

/// The whole of a word as a number. \return false where it is none
bool parse_number(std::string_view word, double& value);
bool parse_integer(std::string_view word, std::int64_t& value);

}  // namespace lozenge::bench
