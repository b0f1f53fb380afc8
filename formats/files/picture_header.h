// What the first bytes of a picture say of it, read without the library that decodes it: so that nobody takes memory
// for a size that can't be true.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace lozenge {

struct PictureHeader {
  std::string_view mime_type;
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::uint32_t channels = 0;
  std::uint32_t bits = 0;  ///< a channel
};

/// Of a PNG, JPEG or WebP, by its content; nothing where it is none of them, or broken so early.
std::optional<PictureHeader> read_picture_header(std::span<const unsigned char> bytes);

/// By its content.
bool is_ktx2(std::span<const unsigned char> bytes);

/// Why a picture shouldn't be decoded; nothing where all is well. "is a KTX2 texture, which isn't read", "claims 65535
/// x 65535 pixels", ...
std::optional<std::string> find_texture_defect(std::span<const unsigned char> bytes);

}  // namespace lozenge
