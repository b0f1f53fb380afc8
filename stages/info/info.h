// Tells what a file holds: for people as lines, for scripts as JSON.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace lozenge {

struct FileInfo {
  std::string kind;                ///< "parameterization", "geometry image", ...
  std::vector<std::string> lines;  ///< for people
  std::string json;                ///< one object, the same facts
};

/// What any of Lozenge's files holds: counts, topology, bounds, Table 1's statistics of a mesh (paper, Sec. 7.1.2), the
/// distortion of a parameterization, layout and levels of an image.
/// \throws Error(kUnusableInput) where the file cannot be read or is none of Lozenge's kinds
FileInfo describe_file(const std::filesystem::path& path);

}  // namespace lozenge
