// Pictures for people, which `render` draws: how they are told from baked maps, and read.
#pragma once

#include <cstdint>
#include <filesystem>

namespace lozenge {

/// The "Description" in the PNG of a picture; a baked map has another one.
inline constexpr const char* kPictureDescription = "lozenge picture";

struct PictureFacts {
  std::int32_t width = 0;  ///< in pixels
  std::int32_t height = 0;
};

/// Decodes the whole picture.
/// \throws Error(kUnusableInput) where it is broken, or isn't 8 bit RGB
PictureFacts read_picture_facts(const std::filesystem::path& path);

}  // namespace lozenge
