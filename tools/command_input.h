// What a command reads, told from what it was given: where that is the file of another stage, which command makes the
// right one.
#pragma once

#include <string>
#include <string_view>

#include "formats/base/error.h"
#include "formats/files/file_kind.h"

namespace lozenge {

/// Where `file` is a sound file of another kind than `command` needs:
/// "statue.glb: is an asset; `lozenge parameterize` makes the map that `sample` needs".
/// \throws Error(kUnusableInput) saying so; does nothing where it is of that kind, or none of ours
void refuse_other_kind(const std::string& file, FileKind needed, std::string_view command);

/// What `read` makes of the file. Only a file that it refuses is looked into for what else it is.
template <typename Read>
auto read_input(const std::string& file, FileKind needed, std::string_view command, const Read& read) {
  try {
    return read(file);
  } catch (const Error& error) {
    if (error.code() == ExitCode::kUnusableInput) refuse_other_kind(file, needed, command);
    throw;
  }
}

}  // namespace lozenge
