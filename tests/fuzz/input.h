// What the fuzz targets of the input formats share: a file is read whole, and what comes out must hold together.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>

#include "formats/files/readers/input_asset.h"
#include "formats/files/readers/input_limits.h"

namespace lozenge::fuzz {

/// As `read_as_file`. Aborts, too, where a triangle names no vertex, an attribute isn't one value for each vertex, or a
/// primitive isn't as large as was said before it was read. \param read  the format's reader
void read_as_input(const std::uint8_t* data, std::size_t size, const std::string& name,
                   InputAsset (*read)(const std::filesystem::path& path, const InputLimits& limits));

}  // namespace lozenge::fuzz
