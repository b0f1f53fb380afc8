// Textures with all their mips in KTX 2.0 containers, as GPUs take them: uncompressed texels, supercompressed by
// Zstandard. Written from Khronos' "KTX File Format Specification" 2.0 and the chapter on basic descriptors of their
// "Data Format Specification" 1.3.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace lozenge {

/// How a texel is stored.
enum class TexelFormat {
  kR8,         ///< one channel of 8 bits
  kRgba8,      ///< four
  kRgba8Srgb,  ///< the first three spaced as sRGB is
  kRgba16,     ///< four channels of 16 bits
};

/// Bytes of a texel.
std::int32_t texel_bytes(TexelFormat format);
std::int32_t texel_channels(TexelFormat format);

struct Ktx2Texture {
  TexelFormat format = TexelFormat::kRgba8;
  std::int32_t width = 0;
  std::int32_t height = 0;
  /// [level, 0 the finest][byte] row by row from the top; each level has half the texels a side of the one before,
  /// rounded down, one at least. 16-bit channels have their low byte first.
  std::vector<std::vector<std::uint8_t>> levels;
  std::string description;  ///< stored under the key "lozenge.map"
};

/// The same texture gives the same bytes. \pre  levels have the sizes that they must have
std::vector<std::uint8_t> ktx2_of(const Ktx2Texture& texture);

/// \throws Error(kUnusableInput) for what isn't a KTX 2.0 file as `ktx2_of` makes them, is broken, or contradicts
/// itself; Error(kLimit) where it has more than `most_side` texels a side
Ktx2Texture read_ktx2(const std::filesystem::path& path, std::int32_t most_side);

/// How a file of the format starts.
inline constexpr std::string_view kKtx2Identifier("\xABKTX 20\xBB\r\n\x1A\n", 12);
inline bool is_ktx2(std::string_view start) { return start.starts_with(kKtx2Identifier); }

}  // namespace lozenge
