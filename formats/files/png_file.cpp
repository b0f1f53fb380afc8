// Each row gets the filter whose bytes, as signed numbers, have the least sum of magnitudes (section 12.8).
#include "formats/files/png_file.h"

#include <libdeflate.h>

#include <array>
#include <cstdlib>
#include <memory>
#include <string_view>

#include "formats/base/error.h"

namespace lozenge {

namespace {

/// Of 1 to 12; above it files hardly become smaller, and take much longer.
constexpr int kEffort = 6;

struct Release {
  void operator()(libdeflate_compressor* c) const { libdeflate_free_compressor(c); }
};

using Bytes = std::vector<std::uint8_t>;

void put_number(Bytes& file, std::uint32_t number) {
  for (int shift = 24; shift >= 0; shift -= 8) file.push_back(static_cast<std::uint8_t>(number >> shift));
}

void put_chunk(Bytes& file, std::string_view type, std::span<const std::uint8_t> data) {
  put_number(file, static_cast<std::uint32_t>(data.size()));
  const std::size_t first = file.size();
  file.insert(file.end(), type.begin(), type.end());
  file.insert(file.end(), data.begin(), data.end());
  put_number(file, libdeflate_crc32(0, file.data() + first, file.size() - first));
}

/// The nearest to left + above - corner (section 9.4).
int paeth(int left, int above, int corner) {
  const int guess = left + above - corner;
  const int to_left = std::abs(guess - left);
  const int to_above = std::abs(guess - above);
  const int to_corner = std::abs(guess - corner);
  if (to_left <= to_above && to_left <= to_corner) return left;
  return to_above <= to_corner ? above : corner;
}

/// A row of bytes and the one above it, of which both begin with a pixel of zeros before the picture.
class Filters {
 public:
  static constexpr int kCount = 5;

  Filters(std::size_t row_bytes, std::size_t pixel_bytes) : pixel_(pixel_bytes) {
    for (Bytes& row : filtered_) row.resize(row_bytes);
  }

  /// \return number of the filter, and the row's bytes by it
  std::pair<std::uint8_t, std::span<const std::uint8_t>> best(const std::uint8_t* row, const std::uint8_t* above) {
    const std::size_t size = filtered_[0].size();
    std::array<std::uint64_t, kCount> sums{};
    for (std::size_t i = 0; i < size; ++i) {
      const int left = row[i - pixel_];
      const int up = above[i];
      const std::array<int, kCount> guesses{0, left, up, (left + up) / 2, paeth(left, up, above[i - pixel_])};
      for (std::size_t k = 0; k < kCount; ++k) {
        const auto byte = static_cast<std::uint8_t>(row[i] - guesses[k]);
        filtered_[k][i] = byte;
        sums[k] += byte < 128 ? byte : 256U - byte;
      }
    }
    std::size_t least = 0;
    for (std::size_t k = 1; k < kCount; ++k) {
      if (sums[k] < sums[least]) least = k;
    }
    return {static_cast<std::uint8_t>(least), filtered_[least]};
  }

 private:
  std::size_t pixel_;
  std::array<Bytes, kCount> filtered_;
};

Bytes filtered_rows(const PngPicture& picture, std::span<const std::uint8_t> pixels) {
  const auto pixel_bytes = static_cast<std::size_t>(picture.channels) * picture.bits / 8;
  const std::size_t row_bytes = picture.width * pixel_bytes;
  Filters filters(row_bytes, pixel_bytes);
  Bytes above(pixel_bytes + row_bytes, 0);
  Bytes row(above.size(), 0);
  Bytes result;
  result.reserve((row_bytes + 1) * picture.height);
  for (std::int32_t y = 0; y < picture.height; ++y) {
    const auto from = pixels.subspan(y * row_bytes, row_bytes);
    std::copy(from.begin(), from.end(), row.begin() + static_cast<std::ptrdiff_t>(pixel_bytes));
    const auto [filter, bytes] = filters.best(row.data() + pixel_bytes, above.data() + pixel_bytes);
    result.push_back(filter);
    result.insert(result.end(), bytes.begin(), bytes.end());
    std::swap(row, above);
  }
  return result;
}

Bytes compressed(const Bytes& bytes) {
  const std::unique_ptr<libdeflate_compressor, Release> compressor(libdeflate_alloc_compressor(kEffort));
  if (!compressor) throw Error(ExitCode::kLimit, "memory ran out while a PNG was made; give it more memory");
  Bytes result(libdeflate_zlib_compress_bound(compressor.get(), bytes.size()));
  result.resize(libdeflate_zlib_compress(compressor.get(), bytes.data(), bytes.size(), result.data(), result.size()));
  return result;
}

Bytes header_of(const PngPicture& picture) {
  constexpr std::array<std::uint8_t, 4> kColourTypes{0, 4, 2, 6};
  Bytes header;
  put_number(header, static_cast<std::uint32_t>(picture.width));
  put_number(header, static_cast<std::uint32_t>(picture.height));
  header.push_back(static_cast<std::uint8_t>(picture.bits));
  header.push_back(kColourTypes[static_cast<std::size_t>(picture.channels - 1)]);
  header.insert(header.end(), {0, 0, 0});  // deflate; the five filters; rows from top to bottom
  return header;
}

}  // namespace

std::vector<std::uint8_t> png_file(const PngPicture& picture, std::span<const std::uint8_t> pixels) {
  Bytes file{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
  put_chunk(file, "IHDR", header_of(picture));
  if (picture.srgb) put_chunk(file, "sRGB", Bytes{0});  // perceptual
  if (!picture.description.empty()) {
    constexpr std::string_view kKeyword = "Description";
    Bytes text(kKeyword.begin(), kKeyword.end());
    text.push_back(0);
    text.insert(text.end(), picture.description.begin(), picture.description.end());
    put_chunk(file, "tEXt", text);
  }
  // A chunk's length is below 2^31.
  constexpr std::size_t kMostInChunk = std::size_t{1} << 30;
  const Bytes data = compressed(filtered_rows(picture, pixels));
  for (std::size_t first = 0; first < data.size(); first += kMostInChunk) {
    put_chunk(file, "IDAT", std::span(data).subspan(first, std::min(kMostInChunk, data.size() - first)));
  }
  put_chunk(file, "IEND", {});
  return file;
}

}  // namespace lozenge
