// The files that an asset consists of.
#pragma once

#include <filesystem>
#include <vector>

namespace lozenge {

/// The files that reading the asset at `path` reads besides itself, whether they are there or not: buffers and images
/// of a glTF. None where it is broken, or can't be read: who reads it will say what is wrong. Each once, in a fixed
/// order.
std::vector<std::filesystem::path> files_named_by(const std::filesystem::path& path);

}  // namespace lozenge
