#include "formats/base/error.h"

#include <algorithm>
#include <array>
#include <cerrno>

namespace lozenge {

ExitCode code_of_refusal(int error) {
  constexpr std::array kWrittenByTheUser{ENOENT, ENOTDIR, EISDIR, EEXIST, ENAMETOOLONG, ELOOP, EINVAL};
  const bool usage = std::find(kWrittenByTheUser.begin(), kWrittenByTheUser.end(), error) != kWrittenByTheUser.end();
  return usage ? ExitCode::kUsage : ExitCode::kSystem;
}

}  // namespace lozenge
