#include "formats/files/texture_encoding.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string>

#include "formats/base/error.h"
#include "formats/files/baked_maps_file.h"
#include "formats/files/openimageio.h"

namespace lozenge {

namespace {

constexpr std::int32_t kMostOfWebp = 16383;  // RFC 9649: 14 bits

/// Whether the map is written in that format, and not as PNG.
bool takes(TextureFormat format, const BakedMap& map) {
  if (format != TextureFormat::kJpeg && format != TextureFormat::kWebp) return false;
  if (traits_of(map.kind).values == MapValues::kDirections || map.channels == 4) return false;
  return format == TextureFormat::kJpeg || std::max(map.width(), map.height()) <= kMostOfWebp;
}

/// RGB, for WebP knows no grey.
std::vector<std::uint8_t> rgb_of(const BakedMap& map) {
  const MapTraits& traits = traits_of(map.kind);
  std::vector<std::uint8_t> pixels;
  pixels.reserve(map.texels.size() / static_cast<std::size_t>(map.channels) * 3);
  for (std::size_t i = 0; i < map.texels.size(); i += static_cast<std::size_t>(map.channels)) {
    for (std::int32_t c = 0; c < 3; ++c) {
      const std::int32_t channel = std::min(c, map.channels - 1);
      const double share = stored_share(traits, channel, map.texels[i + static_cast<std::size_t>(channel)]);
      pixels.push_back(static_cast<std::uint8_t>(std::lround(share * std::numeric_limits<std::uint8_t>::max())));
    }
  }
  return pixels;
}

}  // namespace

EncodedTexture encoded_texture(const BakedMap& map, const TextureEncoding& encoding) {
  const MapTraits& traits = traits_of(map.kind);
  if (!takes(encoding.format, map)) {
    return {"image/png", png_of(map, bits_in_png(traits, encoding.normal_bits))};
  }
  const bool is_jpeg = encoding.format == TextureFormat::kJpeg;
  const std::string format = is_jpeg ? "jpeg" : "webp";
  OIIO::ImageSpec spec(map.width(), map.height(), 3, OIIO::TypeDesc::UINT8);
  spec.attribute("Compression", fmt::format("{}:{}", format, encoding.quality));
  // Channels are quantities of their own: colour that is coarser than brightness would mix them.
  spec.attribute("jpeg:subsampling", "4:4:4");
  EncodedTexture texture{is_jpeg ? "image/jpeg" : "image/webp", {}};
  OIIO::Filesystem::IOVecOutput memory(texture.bytes);
  const std::unique_ptr<OIIO::ImageOutput> out = OIIO::ImageOutput::create(format);
  const bool written = out && out->set_ioproxy(&memory) && out->open("texture." + format, spec) &&
                       out->write_image(OIIO::TypeDesc::UINT8, rgb_of(map).data()) && out->close();
  if (!written) {
    throw Error(ExitCode::kInternal, fmt::format("OpenImageIO can't make a {} of the {} map: {}", format, traits.name,
                                                 out ? out->geterror() : OIIO::geterror()));
  }
  return texture;
}

}  // namespace lozenge
