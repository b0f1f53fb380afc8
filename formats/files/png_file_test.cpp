#include "formats/files/png_file.h"

#include <gtest/gtest.h>

#include <random>

#include "formats/files/openimageio.h"

namespace lozenge {
namespace {

/// Smooth in places, noise in others, so that every filter is the best of some row.
std::vector<std::uint8_t> pixels_of(const PngPicture& picture) {
  std::mt19937 random(7);
  std::vector<std::uint8_t> pixels;
  const std::int32_t row = picture.width * picture.channels * picture.bits / 8;
  for (std::int32_t y = 0; y < picture.height; ++y) {
    for (std::int32_t i = 0; i < row; ++i) {
      const std::int32_t noise = y % 4 == 0   ? static_cast<std::int32_t>(random() % 256)
                                 : y % 4 == 1 ? 3 * y
                                              : i * y / 8;
      pixels.push_back(static_cast<std::uint8_t>(noise));
    }
  }
  return pixels;
}

TEST(PngFile, IsReadByOthersAsItWasWritten) {
  for (const std::int32_t channels : {1, 2, 3, 4}) {
    for (const std::int32_t bits : {8, 16}) {
      const PngPicture picture{37, 29, channels, bits, channels == 3, "what it is"};
      const std::vector<std::uint8_t> pixels = pixels_of(picture);
      const std::vector<std::uint8_t> file = png_file(picture, pixels);

      OIIO::Filesystem::IOMemReader memory(const_cast<std::uint8_t*>(file.data()), file.size());
      OIIO::Filesystem::IOProxy* proxy = &memory;
      OIIO::ImageSpec config;
      config.attribute("oiio:UnassociatedAlpha", 1);
      config.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &proxy);
      const auto input = OIIO::ImageInput::open("picture.png", &config, &memory);
      ASSERT_TRUE(input) << OIIO::geterror();
      EXPECT_EQ(input->spec().width, picture.width);
      EXPECT_EQ(input->spec().height, picture.height);
      EXPECT_EQ(input->spec().nchannels, channels);
      EXPECT_EQ(input->spec().get_string_attribute("ImageDescription"), picture.description);
      std::vector<std::uint8_t> read(pixels.size());
      if (bits == 8) {
        ASSERT_TRUE(input->read_image(0, 0, 0, channels, OIIO::TypeDesc::UINT8, read.data()));
      } else {
        std::vector<std::uint16_t> steps(pixels.size() / 2);
        ASSERT_TRUE(input->read_image(0, 0, 0, channels, OIIO::TypeDesc::UINT16, steps.data()));
        for (std::size_t i = 0; i < steps.size(); ++i) {
          read[2 * i] = static_cast<std::uint8_t>(steps[i] >> 8);
          read[2 * i + 1] = static_cast<std::uint8_t>(steps[i] & 0xFF);
        }
      }
      EXPECT_EQ(read, pixels) << channels << " channels of " << bits << " bits";
    }
  }
}

TEST(PngFile, OfASlopeIsSmallerThanItsPixels) {
  const PngPicture picture{256, 256, 3, 8, false, {}};
  std::vector<std::uint8_t> pixels;
  for (std::int32_t y = 0; y < 256; ++y) {
    for (std::int32_t x = 0; x < 3 * 256; ++x) pixels.push_back(static_cast<std::uint8_t>(x / 3 + y));
  }
  EXPECT_LT(png_file(picture, pixels).size(), pixels.size() / 100);
}

}  // namespace
}  // namespace lozenge
