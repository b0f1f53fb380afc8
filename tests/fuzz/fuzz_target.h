// What all fuzz targets share: bytes become a file, which a reader must take or refuse with one of its own errors.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

namespace lozenge::fuzz {

/// Gives the bytes to `read` as a file. Aborts where anything comes out of it but a result or an Error that blames the
/// input. \param name  of the file, whose extension some readers look at
void read_as_file(const std::uint8_t* data, std::size_t size, const std::string& name,
                  const std::function<void(const std::filesystem::path&)>& read);

}  // namespace lozenge::fuzz
