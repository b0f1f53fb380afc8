// Outputs that appear whole or not at all: written under a temporary name in the same folder, then renamed.
#pragma once

#include <filesystem>
#include <string_view>

#include "formats/base/in_use.h"

namespace lozenge {

/// A file that is being made. What is written to `temporary_path()` becomes `target` when it is committed, in one step;
/// an AtomicFile that goes away without a commit leaves nothing behind, and an older file of that name as it was. What
/// a killed process left is removed by the next AtomicFile in the same folder.
class AtomicFile {
 public:
  /// Makes the temporary file, empty, so that a folder that can't be written is found before the work is done.
  /// \throws Error naming the folder and the reason: kUsage where it doesn't exist, kSystem where it can't be written
  explicit AtomicFile(std::filesystem::path target);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// In the folder of the target, hidden, and with its extension: libraries pick the format by it.
  const std::filesystem::path& temporary_path() const { return temporary_; }

  /// \throws Error(kUsage) or Error(kSystem) naming the target and the reason
  void commit();

 private:
  std::filesystem::path target_;
  std::filesystem::path temporary_;
  HeldFile held_;
  bool committed_ = false;
};

/// Writes `bytes` as the whole content of `path`.
/// \throws Error(kUsage) or Error(kSystem) naming the path and the reason where that fails
void write_file_whole(const std::filesystem::path& path, std::string_view bytes);

/// Removes the temporary files of AtomicFiles in `folder` whose processes were killed.
void remove_abandoned_files(const std::filesystem::path& folder);

}  // namespace lozenge
