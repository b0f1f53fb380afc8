#include "formats/files/picture_header.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace lozenge {
namespace {

using Bytes = std::vector<unsigned char>;

Bytes bytes_of(const std::string& text) { return {text.begin(), text.end()}; }

std::string number(std::uint32_t value) {
  std::string text;
  for (int shift = 24; shift >= 0; shift -= 8) text.push_back(static_cast<char>(value >> shift));
  return text;
}

/// Chunks without pixels and with wrong checksums: all that is looked at here.
Bytes png(std::uint32_t width, std::uint32_t height, std::size_t pixel_bytes) {
  std::string text("\x89PNG\r\n\x1a\n", 8);
  text += number(13) + "IHDR" + number(width) + number(height) + std::string("\x08\x06\0\0\0", 5) + number(0);
  text += number(static_cast<std::uint32_t>(pixel_bytes)) + "IDAT" + std::string(pixel_bytes, 'x') + number(0);
  return bytes_of(text + number(0) + "IEND" + number(0));
}

Bytes jpeg(unsigned width, unsigned height, std::size_t rest) {
  std::string text("\xff\xd8\xff\xe0\x00\x04xx\xff\xc0\x00\x11\x08", 13);
  text += number(height << 16 | width) + std::string("\x03", 1) + std::string(9 + rest, 'x');
  return bytes_of(text);
}

TEST(PictureHeader, TellsTheSizeOfAPngAndOfAJpeg) {
  const auto of_png = read_picture_header(png(640, 480, 1000));
  ASSERT_TRUE(of_png);
  EXPECT_EQ(of_png->mime_type, "image/png");
  EXPECT_EQ(of_png->width, 640U);
  EXPECT_EQ(of_png->height, 480U);
  EXPECT_EQ(of_png->channels, 4U);
  const auto of_jpeg = read_picture_header(jpeg(300, 200, 500));
  ASSERT_TRUE(of_jpeg);
  EXPECT_EQ(of_jpeg->mime_type, "image/jpeg");
  EXPECT_EQ(of_jpeg->width, 300U);
  EXPECT_EQ(of_jpeg->height, 200U);
  EXPECT_EQ(of_jpeg->channels, 3U);
}

TEST(PictureHeader, ReadsNoByteBeyondTheEndOfATruncatedPicture) {
  for (const Bytes& whole : {png(64, 64, 100), jpeg(64, 64, 100),
                             bytes_of(std::string("RIFF\x40\0\0\0WEBPVP8X", 16) + std::string(30, '\1'))}) {
    for (std::size_t size = 0; size < whole.size(); ++size) {
      const Bytes part(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size));
      EXPECT_NO_THROW(read_picture_header(part));
      EXPECT_NO_THROW(find_texture_defect(part));
    }
  }
}

TEST(TextureDefect, IsFoundInWhatClaimsMorePixelsThanItsBytesCanHold) {
  EXPECT_FALSE(find_texture_defect(png(64, 64, 1000)));
  EXPECT_NE(find_texture_defect(png(16384, 16384, 1000))->find("too short"), std::string::npos);
  EXPECT_NE(find_texture_defect(jpeg(8000, 8000, 1000))->find("too short"), std::string::npos);
  EXPECT_NE(find_texture_defect(png(0xffffffff, 0xffffffff, 1000))->find("more than are read"), std::string::npos);
  EXPECT_NE(find_texture_defect(png(0, 16, 1000))->find("no pixels"), std::string::npos);
}

TEST(TextureDefect, NamesFormatsThatAreNotRead) {
  EXPECT_NE(find_texture_defect(bytes_of("\xabKTX 20\xbb\r\n\x1a\n and more"))->find("KTX2"), std::string::npos);
  EXPECT_NE(find_texture_defect(bytes_of("GIF89a and more of it"))->find("no PNG, JPEG or WebP"), std::string::npos);
  EXPECT_TRUE(find_texture_defect({}));
}

}  // namespace
}  // namespace lozenge
