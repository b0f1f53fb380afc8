#include "pipeline/output_name.h"

#include <fmt/format.h>

#include <system_error>

#include "formats/base/error.h"

namespace lozenge {
namespace fs = std::filesystem;

std::string output_name(const fs::path& input, const std::string& asked) {
  std::string name = asked.empty() ? input.stem().string() : asked;
  if (name.empty() || name == "." || name == ".." || name.find('/') != std::string::npos) {
    throw Error(ExitCode::kUsage, fmt::format("'{}' can't be the name of a file; choose another one", name));
  }
  return name;
}

void refuse_to_replace_input(const fs::path& input, const fs::path& output) {
  std::error_code ignored;
  if (!fs::equivalent(input, output, ignored)) return;
  throw Error(ExitCode::kUsage, fmt::format("{}: the output would replace this input; choose another folder or name",
                                            input.filename().string()));
}

}  // namespace lozenge
