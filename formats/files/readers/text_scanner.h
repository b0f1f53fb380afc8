// Words and numbers of a text file, one after the other, with the line that they are in for messages.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "formats/files/readers/input_file.h"

namespace lozenge {

/// Goes through a text once, however long it is. Words are separated by white space; `#` begins a comment that ends
/// with the line; lines end with LF, CR LF or CR. A word's view is good until the next word is asked for.
class TextScanner {
 public:
  explicit TextScanner(InputFile file);

  /// The next word, on whatever line; empty at the end of the text.
  std::string_view word();
  /// The next word of this line; empty where it has no more.
  std::string_view word_of_line();
  /// What is left of this line, without blanks around it, words and comments alike; the start of it where it is longer
  /// than kLongestWord.
  std::string rest_of_line();
  /// Goes to the start of the next line. \return false where there is none
  bool next_line();

  /// The next word as a number, or as the nearest float; `what` names it in messages.
  /// \throws Error(kUnusableInput) where it is none, or the text has ended
  double number(const char* what);
  float float_number(const char* what);
  std::int64_t integer(const char* what);
  /// A number of elements that the file says to have; each takes at least `bytes` of it.
  /// \throws Error(kUnusableInput) where that is negative, or more than what is left of the file can hold
  std::int64_t count(const char* what, std::uint64_t bytes) { return as_count(integer(what), what, bytes); }
  /// The same, of a number that was read already.
  std::int64_t as_count(std::int64_t number, const char* what, std::uint64_t bytes) const;

  /// Of what was read last.
  std::int64_t line() const { return line_; }
  /// Of the next word.
  std::int64_t line_of_next_word();
  /// \throws Error(kUnusableInput) "FILE: line N: PROBLEM"
  [[noreturn]] void refuse(const std::string& problem) const;

  /// What comes next, for who reads bytes after a header of text.
  InputWindow& window() { return window_; }

  static constexpr std::size_t kLongestWord = 1024;

 private:
  void skip_blanks();
  [[noreturn]] void refuse_number(std::string_view text, const char* what, const char* kind) const;

  InputWindow window_;
  std::int64_t line_ = 1;
};

/// The whole of a word as a number. \return false where it is none, or larger than a double (an int64) can be
bool parse_number(std::string_view word, double& value);
bool parse_integer(std::string_view word, std::int64_t& value);
/// The same, as the float that is nearest to what is written; infinite where that is too large for one.
bool parse_float(std::string_view word, float& value);

}  // namespace lozenge
