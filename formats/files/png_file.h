// PNG files (ISO/IEC 15948), made in memory: five filters and a compressor are all that they take, and libdeflate,
// which compresses whole blocks of memory, is three times as fast as the stream of zlib that image libraries write
// through.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace lozenge {

struct PngPicture {
  std::int32_t width = 0;
  std::int32_t height = 0;
  std::int32_t channels = 3;  ///< 1 grey, 2 grey and alpha, 3 RGB, 4 RGB and alpha
  std::int32_t bits = 8;      ///< a channel: 8 or 16
  bool srgb = false;          ///< says that colours are encoded so
  std::string description;    ///< Latin-1, as its text "Description"
};

/// \param pixels  by rows; of 16 bits the higher byte first
/// \pre  sizes of 1 to 2^30, as many bytes as the picture has
/// \throws Error(kLimit) where memory runs out
std::vector<std::uint8_t> png_file(const PngPicture& picture, std::span<const std::uint8_t> pixels);

}  // namespace lozenge
