// PNG: the header is the first chunk (W3C PNG, 11.2.1). JPEG: a row of segments, of which the one that starts a frame
// has the size (ITU-T T.81, B.2). WebP: a RIFF file, whose first chunk says how it goes on (RFC 9649).
#include "formats/files/picture_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <sstream>

#include "formats/files/picture_check.h"

namespace lozenge {

namespace {

using Bytes = std::span<const unsigned char>;

/// Larger pictures than any engine takes.
constexpr std::uint32_t kMostTexels = 32768;
constexpr std::uint64_t kMostPixels = std::uint64_t{1} << 28;
/// No PNG or JPEG holds more bytes of pixels for each of its own.
constexpr std::uint64_t kMostCompression = 2000;

bool holds(Bytes bytes, std::size_t at, std::string_view text) {
  return bytes.size() >= at + text.size() &&
         std::equal(text.begin(), text.end(), bytes.begin() + at,
                    [](char a, auto b) { return static_cast<unsigned char>(a) == b; });
}

std::uint32_t big_endian(Bytes bytes, std::size_t at, int count) {
  std::uint32_t number = 0;
  for (int i = 0; i < count; ++i) number = (number << 8) | bytes[at + i];
  return number;
}

std::uint32_t little_endian(Bytes bytes, std::size_t at, int count) {
  std::uint32_t number = 0;
  for (int i = count; i-- > 0;) number = (number << 8) | bytes[at + i];
  return number;
}

std::optional<PictureHeader> read_png(Bytes bytes) {
  if (bytes.size() < 33 || !holds(bytes, 12, "IHDR")) return std::nullopt;
  constexpr std::array<std::uint32_t, 7> kChannels{1, 0, 3, 4, 2, 0, 4};  // [colour type]; a palette may have alpha
  const unsigned type = bytes[25];
  if (type >= kChannels.size() || kChannels[type] == 0) return std::nullopt;
  return PictureHeader{"image/png", big_endian(bytes, 16, 4), big_endian(bytes, 20, 4), kChannels[type],
                       std::max<std::uint32_t>(bytes[24], 8)};
}

std::optional<PictureHeader> read_jpeg(Bytes bytes) {
  std::size_t at = 2;
  while (at + 4 <= bytes.size() && bytes[at] == 0xFF) {
    const unsigned marker = bytes[at + 1];
    if (marker == 0xFF) {  // fills
      ++at;
      continue;
    }
    const bool starts_frame = marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC;
    if (starts_frame && at + 10 <= bytes.size()) {
      return PictureHeader{"image/jpeg", big_endian(bytes, at + 7, 2), big_endian(bytes, at + 5, 2), bytes[at + 9], 8};
    }
    at += 2 + big_endian(bytes, at + 2, 2);
  }
  return std::nullopt;
}

std::optional<PictureHeader> read_webp(Bytes bytes) {
  if (bytes.size() < 30) return std::nullopt;
  PictureHeader header{"image/webp", 0, 0, 4, 8};
  if (holds(bytes, 12, "VP8X")) {
    header.width = little_endian(bytes, 24, 3) + 1;
    header.height = little_endian(bytes, 27, 3) + 1;
  } else if (holds(bytes, 12, "VP8L")) {
    const std::uint32_t sizes = little_endian(bytes, 21, 4);
    header.width = (sizes & 0x3FFFU) + 1;
    header.height = ((sizes >> 14) & 0x3FFFU) + 1;
  } else if (holds(bytes, 12, "VP8 ")) {
    header.width = little_endian(bytes, 26, 2) & 0x3FFFU;
    header.height = little_endian(bytes, 28, 2) & 0x3FFFU;
  } else {
    return std::nullopt;
  }
  return header;
}

}  // namespace

std::optional<PictureHeader> read_picture_header(Bytes bytes) {
  if (holds(bytes, 0, {"\x89PNG\r\n\x1a\n", 8})) return read_png(bytes);
  if (holds(bytes, 0, "\xff\xd8\xff")) return read_jpeg(bytes);
  if (holds(bytes, 0, "RIFF") && holds(bytes, 8, "WEBP")) return read_webp(bytes);
  return std::nullopt;
}

bool is_ktx2(Bytes bytes) { return holds(bytes, 0, "\xabKTX 20"); }

std::optional<std::string> find_texture_defect(Bytes bytes) {
  if (bytes.empty()) return "has no bytes";
  if (is_ktx2(bytes)) return "is a KTX2 texture, which isn't read";
  const auto header = read_picture_header(bytes);
  if (!header) return "is no PNG, JPEG or WebP";
  const std::uint64_t pixels = std::uint64_t{header->width} * header->height;
  if (pixels == 0) return "has no pixels";
  const bool is_too_large = header->width > kMostTexels || header->height > kMostTexels || pixels > kMostPixels;
  if (is_too_large) return fmt::format("has {} x {} pixels, more than are read", header->width, header->height);
  const bool may_be_tiny = header->mime_type == "image/webp";
  if (!may_be_tiny && pixels * header->channels * header->bits / 8 / kMostCompression > bytes.size()) {
    return fmt::format("is too short for {} x {} pixels", header->width, header->height);
  }
  std::istringstream in(std::string(bytes.begin(), bytes.end()));
  return find_picture_defect(in, bytes.size());
}

}  // namespace lozenge
