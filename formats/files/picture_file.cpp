#include "formats/files/picture_file.h"

#include <fmt/format.h>

#include <vector>

#include "formats/base/error.h"
#include "formats/files/openimageio.h"
#include "formats/files/picture_check.h"

namespace lozenge {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& what) {
  throw Error(ExitCode::kUnusableInput, fmt::format("{}: {}; draw it again", path.filename().string(), what));
}

}  // namespace

PictureFacts read_picture_facts(const std::filesystem::path& path) {
  if (const auto defect = find_picture_defect(path)) refuse(path, *defect);
  const auto in = OIIO::ImageInput::open(path.string());
  if (!in) refuse(path, "it is no picture that can be read: " + OIIO::geterror());
  const OIIO::ImageSpec& spec = in->spec();
  if (spec.nchannels != 3 || spec.format != OIIO::TypeDesc::UINT8) refuse(path, "it is not 8 bit RGB");
  // Row by row, so that a header that promises too much takes no memory.
  std::vector<std::uint8_t> row(static_cast<std::size_t>(spec.width) * 3);
  for (int y = 0; y < spec.height; ++y) {
    if (!in->read_scanline(y, 0, OIIO::TypeDesc::UINT8, row.data())) {
      refuse(path, fmt::format("it breaks off in row {}: {}", y, in->geterror()));
    }
  }
  return {spec.width, spec.height};
}

}  // namespace lozenge
