// Whether the sizes that a PNG or EXR tells of its parts can be true, found out before a library believes them: OpenEXR
// and libpng take memory for an attribute or a chunk of 2 GB in a file of some bytes.
#pragma once

#include <cstdint>
#include <filesystem>
#include <istream>
#include <optional>
#include <string>

namespace lozenge {

/// What is wrong with the chunks of a PNG, or with the headers of an EXR; nothing where all is well, or where it is
/// neither. \param in  at its start \param size  bytes that it has
std::optional<std::string> find_picture_defect(std::istream& in, std::uint64_t size);

/// The same of a file; nothing where there is no such file, which is somebody else's complaint.
std::optional<std::string> find_picture_defect(const std::filesystem::path& file);

}  // namespace lozenge
