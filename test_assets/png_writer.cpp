// W3C PNG: a signature and chunks (5), pixels as a zlib stream (10), here of stored blocks (RFC 1951, 3.2.4).
#include "test_assets/png_writer.h"

#include <algorithm>
#include <string_view>

namespace lozenge::test_assets {
namespace {

using Bytes = std::vector<std::uint8_t>;

void append_number(Bytes& bytes, std::uint32_t number) {
  for (int shift = 24; shift >= 0; shift -= 8) bytes.push_back(static_cast<std::uint8_t>(number >> shift));
}

/// The checksum of a chunk's type and content (Annex D).
std::uint32_t crc_of(const Bytes& bytes, std::size_t from) {
  std::uint32_t crc = 0xffffffffU;
  for (std::size_t i = from; i < bytes.size(); ++i) {
    crc ^= bytes[i];
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ ((crc & 1U) != 0 ? 0xedb88320U : 0U);
  }
  return ~crc;
}

void append_chunk(Bytes& png, std::string_view type, const Bytes& content) {
  append_number(png, static_cast<std::uint32_t>(content.size()));
  const std::size_t start = png.size();
  png.insert(png.end(), type.begin(), type.end());
  png.insert(png.end(), content.begin(), content.end());
  append_number(png, crc_of(png, start));
}

Bytes stored(const Bytes& bytes) {
  Bytes zlib{0x78, 0x01};
  std::uint32_t a = 1;  // Adler-32
  std::uint32_t b = 0;
  for (const std::uint8_t byte : bytes) {
    a = (a + byte) % 65521;
    b = (b + a) % 65521;
  }
  constexpr std::size_t kBlock = 65535;
  for (std::size_t at = 0; at < bytes.size(); at += kBlock) {
    const std::size_t size = std::min(kBlock, bytes.size() - at);
    zlib.push_back(at + size == bytes.size() ? 1 : 0);
    for (const std::size_t length : {size, ~size}) {
      zlib.push_back(static_cast<std::uint8_t>(length));
      zlib.push_back(static_cast<std::uint8_t>(length >> 8));
    }
    zlib.insert(zlib.end(), bytes.begin() + static_cast<std::ptrdiff_t>(at),
                bytes.begin() + static_cast<std::ptrdiff_t>(at + size));
  }
  append_number(zlib, (b << 16) | a);
  return zlib;
}

}  // namespace

Bytes png_bytes(std::uint32_t width, std::uint32_t height, std::uint32_t channels, const Bytes& pixels) {
  Bytes png{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
  Bytes header;
  append_number(header, width);
  append_number(header, height);
  header.insert(header.end(), {8, static_cast<std::uint8_t>(channels == 4 ? 6 : 2), 0, 0, 0});
  append_chunk(png, "IHDR", header);
  Bytes rows;
  for (std::size_t y = 0; y < height; ++y) {
    rows.push_back(0);  // no filter
    const auto row = pixels.begin() + static_cast<std::ptrdiff_t>(y * width * channels);
    rows.insert(rows.end(), row, row + static_cast<std::ptrdiff_t>(width * channels));
  }
  append_chunk(png, "IDAT", stored(rows));
  append_chunk(png, "IEND", {});
  return png;
}

}  // namespace lozenge::test_assets
