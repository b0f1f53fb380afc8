#include "stages/render/picture.h"

#include <algorithm>
#include <cmath>

#include "formats/base/atomic_file.h"
#include "formats/base/error.h"
#include "formats/base/srgb.h"
#include "formats/files/openimageio.h"
#include "formats/files/picture_file.h"

namespace lozenge {

namespace {

std::uint8_t encoded_byte(float linear) {
  const double x = std::clamp(static_cast<double>(linear), 0.0, 1.0);
  return static_cast<std::uint8_t>(std::lround(srgb_of_linear(x) * 255));
}

[[noreturn]] void refuse(ExitCode code, const std::filesystem::path& path, const std::string& reason) {
  throw Error(code, path.string() + ": the picture can't be written (" + reason + ")");
}

}  // namespace

Vec3f srgb(std::uint32_t hex) {
  const auto channel = [&](int shift) { return static_cast<float>(linear_of_srgb(((hex >> shift) & 0xFF) / 255.0)); };
  return {channel(16), channel(8), channel(0)};
}

void write_picture(const std::filesystem::path& path, const Picture& picture) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(picture.pixels.size() * 3);
  for (const Vec3f& p : picture.pixels) {
    for (int c = 0; c < 3; ++c) bytes.push_back(encoded_byte(p[c]));
  }
  if (path.extension() != ".png") refuse(ExitCode::kUsage, path, "its name must end in .png");
  AtomicFile file(path);
  auto output = OIIO::ImageOutput::create("png");
  OIIO::ImageSpec spec(picture.width, picture.height, 3, OIIO::TypeDesc::UINT8);
  spec.attribute("oiio:ColorSpace", "sRGB");
  spec.attribute("png:compressionLevel", 6);
  spec.attribute("ImageDescription", kPictureDescription);
  const bool written = output && output->open(file.temporary_path().string(), spec) &&
                       output->write_image(OIIO::TypeDesc::UINT8, bytes.data()) && output->close();
  if (!written) refuse(ExitCode::kSystem, path, output ? output->geterror() : OIIO::geterror());
  file.commit();
}

}  // namespace lozenge
