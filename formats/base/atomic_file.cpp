#include "formats/base/atomic_file.h"

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <random>
#include <string>
#include <system_error>

#include "formats/base/error.h"

namespace lozenge {

namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const fs::path& target, const std::string& reason) {
  throw Error(ExitCode::kUsage,
              target.string() + ": can't be written: " + reason + "; give -o a folder that exists and is writable");
}

/// \param error  errno \param place  that was refused, with ": " behind it, or nothing where it is the target
[[noreturn]] void refuse(const fs::path& target, int error, const std::string& place = "") {
  const std::string reason = place + std::strerror(error);
  if (code_of_refusal(error) == ExitCode::kUsage) refuse(target, reason);
  throw Error(ExitCode::kSystem,
              target.string() + ": can't be written: " + reason + "; make room, or give -o another folder");
}

fs::path folder_of(const fs::path& target) { return target.has_parent_path() ? target.parent_path() : fs::path("."); }

/// A name that nobody else uses: ".statue.1b2c3d4e5f607182.tmp.exr" for statue.exr, of which half is this machine's
/// tag.
fs::path temporary_name(const fs::path& target) {
  std::random_device random;
  std::array<char, 24> tag{};
  std::snprintf(tag.data(), tag.size(), ".%s%08x.tmp", tag_of_machine().c_str(), random());
  std::string name(".");
  name += target.stem().string();
  name += tag.data();
  name += target.extension().string();
  return folder_of(target) / name;
}

bool is_temporary_name(const std::string& name) {
  const std::size_t end = name.rfind(".tmp");
  constexpr std::size_t kDigits = 16;
  if (!name.starts_with('.') || end == std::string::npos || end < kDigits + 2 || name[end - kDigits - 1] != '.') {
    return false;
  }
  return name.find_first_not_of("0123456789abcdef", end - kDigits) == end;
}

}  // namespace

AtomicFile::AtomicFile(fs::path target) : target_(std::move(target)) {
  std::error_code ignored;
  const fs::path folder = folder_of(target_);
  if (!target_.has_filename() || fs::is_directory(target_, ignored)) refuse(target_, "it is a folder");
  if (!fs::exists(folder, ignored)) refuse(target_, "there is no folder " + folder.string());
  if (!fs::is_directory(folder, ignored)) refuse(target_, folder.string() + " is not a folder");
  remove_abandoned_files(folder);
  int reason = EEXIST;
  for (int attempt = 0; reason == EEXIST && attempt < 16; ++attempt) {
    temporary_ = temporary_name(target_);
    reason = held_.make(temporary_);
  }
  if (reason != 0) refuse(target_, reason, "folder " + folder.string() + ": ");
}

AtomicFile::~AtomicFile() {
  if (committed_) return;
  std::error_code ignored;
  fs::remove(temporary_, ignored);
}

void AtomicFile::commit() {
  std::error_code error;
  fs::rename(temporary_, target_, error);
  if (error) refuse(target_, error.value());
  committed_ = true;
}

void remove_abandoned_files(const fs::path& folder) {
  std::error_code ignored;
  for (fs::directory_iterator entry(folder, ignored), end; !ignored && entry != end; entry.increment(ignored)) {
    const fs::path& file = entry->path();
    if (is_temporary_name(file.filename().string())) remove_if_abandoned(file, file);
  }
}

void write_file_whole(const fs::path& path, std::string_view bytes) {
  AtomicFile file(path);
  std::FILE* stream = std::fopen(file.temporary_path().c_str(), "wb");
  if (stream == nullptr) refuse(path, errno);
  const bool written = std::fwrite(bytes.data(), 1, bytes.size(), stream) == bytes.size();
  int reason = errno;
  const bool closed = std::fclose(stream) == 0;
  if (written && !closed) reason = errno;
  if (!written || !closed) refuse(path, reason);
  file.commit();
}

}  // namespace lozenge
