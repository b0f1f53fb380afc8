#include "formats/base/scratch_folder.h"

#include <cerrno>
#include <cstdlib>
#include <system_error>

namespace lozenge {
namespace fs = std::filesystem;
namespace {

void remove_abandoned(const fs::path& parent, const std::string& prefix) {
  std::error_code ignored;
  for (fs::directory_iterator entry(parent, ignored), end; !ignored && entry != end; entry.increment(ignored)) {
    const fs::path& folder = entry->path();
    std::error_code error;
    if (!folder.filename().string().starts_with(prefix) || !entry->is_directory(error)) continue;
    remove_if_abandoned(folder / ScratchFolder::kHeldName, folder);
  }
}

}  // namespace

ScratchFolder::ScratchFolder(const fs::path& parent, const std::string& prefix) {
  remove_abandoned(parent, prefix);
  int reason = EEXIST;
  for (int attempt = 0; reason == EEXIST && attempt < 16; ++attempt) {
    std::string name = (parent / (prefix + tag_of_machine() + "-XXXXXX")).string();
    reason = mkdtemp(name.data()) == nullptr ? errno : held_.make(fs::path(name) / kHeldName);
    if (reason == 0) path_ = name;
    std::error_code ignored;
    if (reason != 0 && fs::is_directory(name, ignored)) fs::remove_all(name, ignored);
  }
  if (reason != 0) {
    throw fs::filesystem_error("no folder can be made", parent, std::error_code(reason, std::generic_category()));
  }
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

}  // namespace lozenge
