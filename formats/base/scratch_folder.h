// A folder for what is in the making, which doesn't outlive its maker for long.
#pragma once

#include <filesystem>
#include <string>

#include "formats/base/in_use.h"

namespace lozenge {

/// A new folder of its own, removed with all that is in it when the object goes. Where the process is killed before,
/// the next ScratchFolder in that place removes it.
class ScratchFolder {
 public:
  /// Makes PARENT/PREFIXxxxxxxxx-XXXXXX, and removes those of that prefix that nobody works in any more.
  /// \throws std::filesystem::filesystem_error where it can't be made
  ScratchFolder(const std::filesystem::path& parent, const std::string& prefix);
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

  /// The file in it that says that it is in use.
  static constexpr const char* kHeldName = ".lozenge-in-use";

 private:
  std::filesystem::path path_;
  HeldFile held_;
};

}  // namespace lozenge
