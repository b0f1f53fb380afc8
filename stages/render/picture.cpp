#include "stages/render/picture.h"

#include <algorithm>
#include <cmath>

#include "formats/base/atomic_file.h"
#include "formats/base/error.h"
#include "formats/base/srgb.h"
#include "formats/files/picture_file.h"
#include "formats/files/png_file.h"

namespace lozenge {

namespace {

std::uint8_t encoded_byte(float linear) {
  const double x = std::clamp(static_cast<double>(linear), 0.0, 1.0);
  return static_cast<std::uint8_t>(std::lround(srgb_of_linear(x) * 255));
}

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& reason) {
  throw Error(ExitCode::kUsage, path.string() + ": the picture can't be written (" + reason + ")");
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
  if (path.extension() != ".png") refuse(path, "its name must end in .png");
  const std::vector<std::uint8_t> file =
      png_file({picture.width, picture.height, 3, 8, true, std::string(kPictureDescription)}, bytes);
  write_file_whole(path, {reinterpret_cast<const char*>(file.data()), file.size()});
}

}  // namespace lozenge
