// Outputs that appear whole or not at all: written under a temporary name in the same folder, then renamed.
#pragma once

#include <filesystem>
#include <string_view>

namespace lozenge {

/// A file that is being made. What is written to `temporary_path()` becomes `target` when it is committed, in one step;
/// an AtomicFile that goes away without a commit leaves nothing behind, and an older file of that name as it was.
class AtomicFile {
 public:
  /// Makes the temporary file, empty, so that a folder that can't be written is found before the work is done.
  /// \throws Error(kUsage) naming the folder and the reason where it doesn't exist or can't be written
  explicit AtomicFile(std::filesystem::path target);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// In the folder of the target, hidden, and with its extension: libraries pick the format by it.
  const std::filesystem::path& temporary_path() const { return temporary_; }

  /// \throws Error(kUsage) naming the target and the reason
  void commit();

 private:
  std::filesystem::path target_;
  std::filesystem::path temporary_;
  bool committed_ = false;
};

/// Writes `bytes` as the whole content of `path`.
/// \throws Error(kUsage) naming the path and the reason where that fails
void write_file_whole(const std::filesystem::path& path, std::string_view bytes);

}  // namespace lozenge
