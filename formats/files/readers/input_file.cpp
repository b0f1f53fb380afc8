#include "formats/files/readers/input_file.h"

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "formats/base/error.h"
#include "formats/base/utf8.h"

namespace lozenge {

namespace {

namespace fs = std::filesystem;

[[noreturn]] void broken(const std::string& what, const std::string& problem) {
  throw Error(ExitCode::kUnusableInput, what + ": " + problem);
}

}  // namespace

std::string file_name_of(const fs::path& path) { return valid_utf8(path.filename().string()); }

InputStart start_of(const fs::path& path) {
  constexpr std::uint64_t kStart = 4096;
  InputFile file(path, file_name_of(path));
  InputStart start{std::string(std::min(kStart, file.size()), '\0'), file.size()};
  file.read(start.bytes.data(), start.bytes.size());
  return start;
}

InputFile::InputFile(const fs::path& path, std::string what) : what_(std::move(what)) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) broken(what_, "there is no such file at " + path.string());
  if (!fs::is_regular_file(status)) broken(what_, "is not a file");
  size_ = fs::file_size(path, error);
  if (error) broken(what_, "can't be read: " + error.message());
  stream_.open(path, std::ios::binary);
  if (!stream_) broken(what_, std::string("can't be read: ") + std::strerror(errno));
}

void InputFile::read(void* to, std::uint64_t count) {
  stream_.read(static_cast<char*>(to), static_cast<std::streamsize>(count));
  if (!stream_) broken(what_, "ended while it was read");
  position_ += count;
}

void InputFile::skip(std::uint64_t count) {
  stream_.seekg(static_cast<std::streamoff>(count), std::ios::cur);
  position_ += count;
}

void InputFile::rewind() {
  stream_.seekg(0);
  position_ = 0;
}

InputWindow::InputWindow(InputFile file)
    : file_(std::move(file)), buffer_(std::min<std::uint64_t>(4 * kMostAhead, file_.size())) {}

void InputWindow::fill() {
  std::memmove(buffer_.data(), buffer_.data() + at_, end_ - at_);
  end_ -= at_;
  at_ = 0;
  const std::uint64_t count = std::min<std::uint64_t>(buffer_.size() - end_, file_.left());
  file_.read(buffer_.data() + end_, count);
  end_ += count;
}

}  // namespace lozenge
