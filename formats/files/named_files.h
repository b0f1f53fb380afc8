// The files that an asset consists of.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace lozenge {

/// The files that reading the asset at `path` reads besides itself, whether they are there or not: buffers and images
/// of a glTF. None where it is broken, or can't be read: who reads it will say what is wrong. Each once, in a fixed
/// order.
std::vector<std::filesystem::path> files_named_by(const std::filesystem::path& path);

/// Of the asset and the files that it names: their names and contents.
/// \throws Error where one that is there can't be read
std::string content_hash_of_asset(const std::filesystem::path& path);

}  // namespace lozenge
