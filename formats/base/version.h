// The version that files and reports carry.
#pragma once

#include <string_view>

namespace lozenge {

/// "0.1.0"; set by the build.
std::string_view version();

}  // namespace lozenge
