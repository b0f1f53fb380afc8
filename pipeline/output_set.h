// Files that appear in a folder together, or not at all.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "formats/base/scratch_folder.h"

namespace lozenge {

/// Gathers the files of one asset in a hidden folder inside the output folder, under the names that they will have, and
/// moves them to their places when all are complete. Where that never comes about, the hidden folder disappears, and so
/// does every folder that was made on the way; where the process is killed, the next OutputSet in the folder removes
/// the hidden one.
class OutputSet {
 public:
  /// Makes `folder`, and the folders above it, where they don't exist.
  /// \throws Error where that can't be done or nothing can be written there: kUsage or kSystem, by whose fault it is
  explicit OutputSet(const std::filesystem::path& folder);
  ~OutputSet();
  OutputSet(const OutputSet&) = delete;
  OutputSet& operator=(const OutputSet&) = delete;

  /// Where to write the file that will be called `name`.
  std::filesystem::path staged(const std::string& name) const { return staging_->path() / name; }
  /// The hidden folder itself.
  const std::filesystem::path& staging_folder() const { return staging_->path(); }

  /// Of the files that were written so far.
  std::vector<std::string> names() const;

  /// Moves every file that was written so far to its place, replacing what had that name.
  /// \param last  the file that is moved last: where the process is killed in between, whoever looks at that one alone
  ///              (a build system) does all again
  /// \return the files' final paths, by name
  /// \throws Error(kUsage) or Error(kSystem) where one can't be replaced; then all are as they were before
  std::vector<std::filesystem::path> commit(const std::string& last = {});

 private:
  void remove_traces() noexcept;

  std::filesystem::path folder_;
  std::unique_ptr<ScratchFolder> staging_;
  std::vector<std::filesystem::path> made_folders_;  ///< outermost first; those that didn't exist before
};

}  // namespace lozenge
