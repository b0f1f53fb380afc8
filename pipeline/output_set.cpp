// The files are staged inside the output folder itself, so that moving them to their places is a rename on one file
// system. A rename replaces a file in one step; what it replaces is kept as a second link until all renames have
// succeeded, so that a failure in the middle can be undone.
#include "pipeline/output_set.h"

#include <algorithm>
#include <system_error>

#include "formats/base/error.h"

namespace lozenge {
namespace fs = std::filesystem;
namespace {

[[noreturn]] void fail(const fs::path& place, const std::string& what, const std::error_code& reason) {
  throw Error(code_of_refusal(reason.value()),
              place.string() + ": " + what + " (" + reason.message() + "); choose another output folder with -o");
}

/// Makes `folder` and its parents; those that are new are appended to `made`, outermost first.
void make_folders(const fs::path& folder, std::vector<fs::path>& made) {
  std::vector<fs::path> missing;
  for (fs::path p = folder; !p.empty(); p = p.parent_path()) {
    std::error_code ignored;
    if (fs::exists(p, ignored) || p == p.parent_path()) break;
    missing.push_back(p);
  }
  std::reverse(missing.begin(), missing.end());
  for (const fs::path& p : missing) {
    std::error_code error;
    if (fs::create_directory(p, error)) made.push_back(p);
    if (error) fail(p, "can't make this folder", error);
  }
  if (!fs::is_directory(folder)) {
    fail(folder, "can't be the output folder", std::make_error_code(std::errc::not_a_directory));
  }
}

std::unique_ptr<ScratchFolder> make_staging_folder(const fs::path& folder) {
  try {
    return std::make_unique<ScratchFolder>(folder, ".lozenge-");
  } catch (const fs::filesystem_error& refusal) {
    fail(folder, "can't write into this folder", refusal.code());
  }
}

/// Of the files, as they are to be moved.
std::vector<std::string> names_in(const fs::path& folder, const std::string& last) {
  std::vector<std::string> names;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (entry.is_regular_file() && name != ScratchFolder::kHeldName) names.push_back(name);
  }
  std::sort(names.begin(), names.end(), [&](const std::string& a, const std::string& b) {
    return std::pair(a == last, a) < std::pair(b == last, b);
  });
  return names;
}

/// A second link to `file` (a copy where the file system has no links) at `backup`.
/// \return whether there was a file
bool keep(const fs::path& file, const fs::path& backup) {
  if (!fs::exists(fs::symlink_status(file))) return false;
  if (fs::is_directory(file))
    throw fs::filesystem_error("a folder has this name", std::make_error_code(std::errc::is_a_directory));
  std::error_code error;
  fs::create_hard_link(file, backup, error);
  if (error) fs::copy(file, backup, fs::copy_options::copy_symlinks);
  return true;
}

}  // namespace

OutputSet::OutputSet(const fs::path& folder) : folder_(folder.empty() ? fs::path(".") : folder.lexically_normal()) {
  if (!folder_.has_filename()) folder_ = folder_.parent_path();
  try {
    make_folders(folder_, made_folders_);
    staging_ = make_staging_folder(folder_);
  } catch (...) {
    remove_traces();
    throw;
  }
}

OutputSet::~OutputSet() { remove_traces(); }

std::vector<std::string> OutputSet::names() const { return names_in(staging_folder(), {}); }

std::vector<fs::path> OutputSet::commit(const std::string& last) {
  struct Move {
    fs::path place;
    fs::path backup;
    bool replaces;
  };
  std::vector<Move> done;
  fs::path place;
  try {
    const std::vector<std::string> names = names_in(staging_folder(), last);
    const fs::path backups = staging_folder() / "previous";
    fs::create_directory(backups);
    for (const std::string& name : names) {
      place = folder_ / name;
      const bool replaces = keep(place, backups / name);
      fs::rename(staged(name), place);
      done.push_back({place, backups / name, replaces});
    }
  } catch (const fs::filesystem_error& error) {
    for (const Move& move : done) {
      std::error_code ignored;
      if (move.replaces) {
        fs::rename(move.backup, move.place, ignored);
      } else {
        fs::remove(move.place, ignored);
      }
    }
    fail(place, "can't put the output here", error.code());
  }
  made_folders_.clear();
  std::vector<fs::path> places;
  for (const Move& move : done) places.push_back(move.place);
  std::sort(places.begin(), places.end());
  return places;
}

void OutputSet::remove_traces() noexcept {
  std::error_code ignored;
  staging_.reset();
  // Only what is empty goes: somebody else may have put something there in the meantime.
  for (auto folder = made_folders_.rbegin(); folder != made_folders_.rend(); ++folder) fs::remove(*folder, ignored);
}

}  // namespace lozenge
