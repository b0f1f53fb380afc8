// Temporary files and folders whose makers may be killed: how the next one tells that nobody works in them any more.
//
// A maker holds a lock on what it made, which the kernel drops when the process ends, however it ends. Nobody ever
// waits for such a lock. Where locks of another machine may be invisible (network file systems can be mounted so), what
// that machine made is given up on after a day.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace lozenge {

/// Eight hexadecimal digits for this machine, which are a part of the names of what it makes.
std::string tag_of_machine();

/// A new file, held by this process while the object lives.
class HeldFile {
 public:
  HeldFile() = default;
  /// Makes the file, empty. \return 0, or errno where that can't be done (EEXIST where there is one of that name)
  int make(const std::filesystem::path& path);
  ~HeldFile();
  HeldFile(const HeldFile&) = delete;
  HeldFile& operator=(const HeldFile&) = delete;

 private:
  int descriptor_ = -1;
};

/// Removes what somebody made, if whoever held it is gone. The lock is kept until all of it is removed: a maker that
/// has made the file, but doesn't hold it yet, finds out that it is lost. \param held  the file; where there is none
/// (its maker was killed before it was there), age decides \param whole  what it stands for, itself or the folder that
/// it is in; its name has the tag of its maker's machine
void remove_if_abandoned(const std::filesystem::path& held, const std::filesystem::path& whole);

}  // namespace lozenge
