// Broken copies of EXR files, for tests of their readers.
#pragma once

#include <ImfHeader.h>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace lozenge::fixtures {

/// One part of an EXR in memory: its header, and all 32-bit channels by name order, each row by row.
struct ExrPart {
  Imf::Header header;
  std::vector<std::vector<std::uint32_t>> channels;
};

/// Takes an attribute out of a header. (OpenEXR's own `erase` forgets to free it.)
void remove_attribute(Imf::Header& header, const std::string& name);

/// Copies a tiled EXR through `change`, which may alter headers and pixels; those that a header asks for and the part
/// does not have are zeros.
void rewrite_exr(const std::filesystem::path& from, const std::filesystem::path& to,
                 const std::function<void(std::vector<ExrPart>&)>& change);

}  // namespace lozenge::fixtures
