// Files that appear in a folder together, or not at all.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace lozenge {

/// Gathers the files of one asset in a hidden folder inside the output folder, under the names that they will have, and
/// moves them to their places when all are complete. Where that never comes about, the hidden folder disappears, and so
/// does every folder that was made on the way.
class OutputSet {
 public:
  /// Makes `folder`, and the folders above it, where they don't exist.
  /// \throws Error(kUsage) where that can't be done or nothing can be written there
  explicit OutputSet(const std::filesystem::path& folder);
  ~OutputSet();
  OutputSet(const OutputSet&) = delete;
  OutputSet& operator=(const OutputSet&) = delete;

  /// Where to write the file that will be called `name`.
  std::filesystem::path staged(const std::string& name) const { return staging_ / name; }
  /// The hidden folder itself.
  const std::filesystem::path& staging_folder() const { return staging_; }

  /// Moves every file that was written so far to its place, replacing what had that name.
  /// \return the files' final paths, by name
  /// \throws Error(kUsage) where one can't be replaced; then all are as they were before
  std::vector<std::filesystem::path> commit();

 private:
  void remove_traces() noexcept;

  std::filesystem::path folder_;
  std::filesystem::path staging_;
  std::vector<std::filesystem::path> made_folders_;  ///< outermost first; those that didn't exist before
};

}  // namespace lozenge
