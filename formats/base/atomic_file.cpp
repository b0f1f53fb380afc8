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

fs::path folder_of(const fs::path& target) { return target.has_parent_path() ? target.parent_path() : fs::path("."); }

/// A name that nobody else uses: ".statue.1b2c3d4e5f607182.tmp.exr" for statue.exr.
fs::path temporary_name(const fs::path& target) {
  std::random_device random;
  std::array<char, 24> tag{};
  std::snprintf(tag.data(), tag.size(), ".%08x%08x.tmp", random(), random());
  std::string name(".");
  name += target.stem().string();
  name += tag.data();
  name += target.extension().string();
  return folder_of(target) / name;
}

/// Makes the file, which must not exist yet. \return 0 or the reason
int create(const fs::path& path) {
  std::FILE* file = std::fopen(path.c_str(), "wbx");
  if (file == nullptr) return errno;
  std::fclose(file);
  return 0;
}

}  // namespace

AtomicFile::AtomicFile(fs::path target) : target_(std::move(target)) {
  std::error_code ignored;
  const fs::path folder = folder_of(target_);
  if (!target_.has_filename() || fs::is_directory(target_, ignored)) refuse(target_, "it is a folder");
  if (!fs::exists(folder, ignored)) refuse(target_, "there is no folder " + folder.string());
  if (!fs::is_directory(folder, ignored)) refuse(target_, folder.string() + " is not a folder");
  int reason = EEXIST;
  for (int attempt = 0; reason == EEXIST && attempt < 16; ++attempt) {
    temporary_ = temporary_name(target_);
    reason = create(temporary_);
  }
  if (reason != 0) refuse(target_, "folder " + folder.string() + ": " + std::strerror(reason));
}

AtomicFile::~AtomicFile() {
  if (committed_) return;
  std::error_code ignored;
  fs::remove(temporary_, ignored);
}

void AtomicFile::commit() {
  std::error_code error;
  fs::rename(temporary_, target_, error);
  if (error) refuse(target_, error.message());
  committed_ = true;
}

void write_file_whole(const fs::path& path, std::string_view bytes) {
  AtomicFile file(path);
  std::FILE* stream = std::fopen(file.temporary_path().c_str(), "wb");
  if (stream == nullptr) refuse(path, std::strerror(errno));
  const bool written = std::fwrite(bytes.data(), 1, bytes.size(), stream) == bytes.size();
  int reason = errno;
  const bool closed = std::fclose(stream) == 0;
  if (written && !closed) reason = errno;
  if (!written || !closed) refuse(path, std::strerror(reason));
  file.commit();
}

}  // namespace lozenge
