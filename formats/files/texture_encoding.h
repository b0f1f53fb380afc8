// Baked maps as the pictures that an asset holds.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "formats/patches/baked_maps.h"

namespace lozenge {

enum class TextureFormat : std::uint8_t {
  kPng,
  kJpeg,
  kWebp,
  kKtx2,    ///< PNG in the asset; who makes its maps writes them as KTX 2.0 beside it, with mips
  kBasisu,  ///< the same, and of those an asset of UASTC textures
};

struct TextureEncoding {
  TextureFormat format = TextureFormat::kPng;
  int quality = 90;     ///< of JPEG and WebP, 1 to 100
  int normal_bits = 8;  ///< a channel of directions, 8 or 16
};

struct EncodedTexture {
  std::string_view mime_type = "image/png";
  std::vector<std::uint8_t> bytes;
};

/// In the format that is asked for, if that keeps what the map says: directions and what has alpha are PNG always.
/// (JPEG has no alpha. OpenImageIO writes WebP with losses alone, and without the colours of what isn't covered, which
/// filters need.) So is what is larger than a WebP may be.
EncodedTexture encoded_texture(const BakedMap& map, const TextureEncoding& encoding);

}  // namespace lozenge
