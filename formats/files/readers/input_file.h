// An input file, open for reading: as a whole, or through a window, so that a file of gigabytes never is in memory.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include "formats/files/readers/input_start.h"

namespace lozenge {

/// How messages call a file: its name without folders, as well-formed UTF-8.
std::string file_name_of(const std::filesystem::path& path);

/// \throws Error(kUnusableInput) where there is no such file, or it can't be read
InputStart start_of(const std::filesystem::path& path);

/// An open file that knows its size and never reads past it.
class InputFile {
 public:
  /// \param what  begins messages: "statue.glb"
  /// \throws Error(kUnusableInput) where there is no such file, or it can't be read
  InputFile(const std::filesystem::path& path, std::string what);

  const std::string& what() const { return what_; }
  std::uint64_t size() const { return size_; }
  std::uint64_t left() const { return size_ - position_; }

  /// \pre count <= left()
  /// \throws Error(kUnusableInput) where the file became shorter while it was read
  void read(void* to, std::uint64_t count);
  void skip(std::uint64_t count);
  void rewind();

 private:
  std::string what_;
  std::ifstream stream_;
  std::uint64_t size_ = 0;
  std::uint64_t position_ = 0;
};

/// A window that moves over a file, from its start to its end.
class InputWindow {
 public:
  explicit InputWindow(InputFile file);

  const std::string& what() const { return file_.what(); }

  /// What is in the window; at least `count` bytes of what comes next, or all that the file still has. Views stay good
  /// until the next call. \pre count <= kMostAhead
  std::string_view ahead(std::size_t count) {
    if (end_ - at_ < count && file_.left() > 0) fill();
    return {buffer_.data() + at_, end_ - at_};
  }
  /// \pre that much is in the window
  void skip(std::size_t count) { at_ += count; }

  /// Bytes before the window's start.
  std::uint64_t offset() const { return file_.size() - left(); }
  /// Bytes from there to the file's end.
  std::uint64_t left() const { return file_.left() + (end_ - at_); }

  static constexpr std::size_t kMostAhead = std::size_t{1} << 16;

 private:
  void fill();

  InputFile file_;
  std::vector<char> buffer_;
  std::size_t at_ = 0;
  std::size_t end_ = 0;
};

}  // namespace lozenge
