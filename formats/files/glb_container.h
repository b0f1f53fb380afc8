// The frame of a GLB: header, JSON, one binary chunk (glTF 2.0 specification, Sec. 4).
#pragma once

#include <cstdint>
#include <ostream>
#include <span>
#include <string_view>

namespace lozenge {

inline constexpr std::uint32_t kGlbMagic = 0x46546C67;   ///< "glTF"
inline constexpr std::uint32_t kGlbJson = 0x4E4F534A;    ///< type of a chunk: "JSON"
inline constexpr std::uint32_t kGlbBinary = 0x004E4942;  ///< "BIN"

/// Without a binary chunk where `binary` is empty. \throws Error(kLimit) where it would pass the 4 GB of a GLB
void write_glb_container(std::ostream& stream, std::string_view text, std::span<const unsigned char> binary);

}  // namespace lozenge
