#include "formats/base/in_use.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstdint>

namespace lozenge {
namespace fs = std::filesystem;
namespace {

bool is_a_day_old(const fs::path& path) {
  std::error_code error;
  const fs::file_time_type changed = fs::last_write_time(path, error);
  return !error && fs::file_time_type::clock::now() - changed > std::chrono::hours(24);
}

/// Whether the open file is still what is at `path`.
bool is_at(int descriptor, const fs::path& path) {
  struct stat open {};
  struct stat there {};
  return fstat(descriptor, &open) == 0 && stat(path.c_str(), &there) == 0 && open.st_dev == there.st_dev &&
         open.st_ino == there.st_ino;
}

}  // namespace

std::string tag_of_machine() {
  std::array<char, 256> name{};
  gethostname(name.data(), name.size() - 1);
  // FNV-1a
  std::uint32_t tag = 2166136261;
  for (const char* c = name.data(); *c != '\0'; ++c) tag = (tag ^ static_cast<unsigned char>(*c)) * 16777619;
  return fmt::format("{:08x}", tag);
}

int HeldFile::make(const fs::path& path) {
  descriptor_ = open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (descriptor_ < 0) return errno;
  // Between the two calls somebody may have taken it for abandoned.
  const bool lost = flock(descriptor_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  if (!lost && is_at(descriptor_, path)) return 0;
  close(descriptor_);
  descriptor_ = -1;
  return EEXIST;
}

HeldFile::~HeldFile() {
  if (descriptor_ >= 0) close(descriptor_);
}

void remove_if_abandoned(const fs::path& held, const fs::path& whole) {
  const bool is_ours = whole.filename().string().find(tag_of_machine()) != std::string::npos;
  std::error_code ignored;
  const int descriptor = open(held.c_str(), O_RDWR | O_CLOEXEC);
  if (descriptor < 0) {
    if (errno == ENOENT && is_a_day_old(whole)) fs::remove_all(whole, ignored);
    return;
  }
  const bool is_free = flock(descriptor, LOCK_EX | LOCK_NB) == 0;
  if (is_free && (is_ours || is_a_day_old(whole))) fs::remove_all(whole, ignored);
  close(descriptor);
}

}  // namespace lozenge
