// OpenImageIO encodes and decodes the pixels; what a map is beyond its pixels stands in one text field. A file is not
// believed before its own description, its size and its channels agree.
#include "formats/files/baked_maps_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <memory>
#include <optional>
#include <system_error>
#include <utility>

#include "formats/base/atomic_file.h"
#include "formats/base/error.h"
#include "formats/files/map_description.h"
#include "formats/files/map_steps.h"
#include "formats/files/openimageio.h"
#include "formats/files/picture_check.h"
#include "formats/files/png_file.h"

namespace lozenge {

namespace {

/// No file of PNG or EXR holds more bytes of pixels than this for each byte of its own: the limit of the deflate
/// format, with some room. More is claimed by files that want our memory.
constexpr std::int64_t kMostCompression = 1100;

bool is_turned(const BakedMap& map, NormalY normal_y) {
  return normal_y == NormalY::kDown && holds_tangent_space_normals(traits_of(map.kind));
}

/// With y pointing the other way.
BakedMap turned(BakedMap map) {
  for (std::size_t i = 1; i < map.texels.size(); i += static_cast<std::size_t>(map.channels)) {
    map.texels[i] = 0.0F - map.texels[i];
  }
  map.png = nullptr;
  return map;
}

/// \param normal_y  where y points in the map as it is
std::vector<std::uint8_t> encoded_exr(const BakedMap& map, int bits, NormalY normal_y) {
  OIIO::ImageSpec spec(map.width(), map.height(), map.channels,
                       bits == 16 ? OIIO::TypeDesc::HALF : OIIO::TypeDesc::FLOAT);
  spec.attribute("ImageDescription", map_description(map, normal_y));
  // Colours aren't multiplied by alpha, neither in memory nor in the file.
  if (map.channels == 4) spec.attribute("oiio:UnassociatedAlpha", 1);
  // OpenImageIO would write the time of day.
  spec.attribute("DateTime", "");
  std::vector<std::uint8_t> bytes;
  OIIO::Filesystem::IOVecOutput memory(bytes);
  const std::unique_ptr<OIIO::ImageOutput> out = OIIO::ImageOutput::create("openexr");
  const bool written = out && out->set_ioproxy(&memory) && out->open("map.exr", spec) &&
                       out->write_image(OIIO::TypeDesc::FLOAT, map.texels.data()) && out->close();
  if (!written) {
    throw Error(ExitCode::kInternal, fmt::format("OpenImageIO can't make an EXR of the {} map: {}",
                                                 traits_of(map.kind).name, out ? out->geterror() : OIIO::geterror()));
  }
  return bytes;
}

std::vector<std::uint8_t> encoded_png(const BakedMap& map, int bits, NormalY normal_y) {
  const PngPicture picture{map.width(), map.height(), map.channels, bits, false, map_description(map, normal_y)};
  if (bits == 8) return png_file(picture, quantized<std::uint8_t>(traits_of(map.kind), map.channels, map.texels));
  std::vector<std::uint8_t> bytes;
  for (const std::uint16_t step : quantized<std::uint16_t>(traits_of(map.kind), map.channels, map.texels)) {
    bytes.push_back(static_cast<std::uint8_t>(step >> 8));
    bytes.push_back(static_cast<std::uint8_t>(step & 0xFF));
  }
  return png_file(picture, bytes);
}

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& reason) {
  throw Error(ExitCode::kUnusableInput, fmt::format("{}: {}; bake it again", path.string(), reason));
}

/// \throws Error where the picture's size can't be true
void require_plausible_size(const std::filesystem::path& path, const OIIO::ImageSpec& spec) {
  if (spec.width < 1 || spec.height < 1 || spec.depth > 1) refuse(path, "its size makes no sense");
  if (spec.width > kMostMapSize || spec.height > kMostMapSize) {
    throw Error(ExitCode::kLimit, fmt::format("{}: {} x {} texels are more than {} a side; bake a smaller map",
                                              path.string(), spec.width, spec.height, kMostMapSize));
  }
  std::error_code error;
  const auto size = static_cast<std::int64_t>(std::filesystem::file_size(path, error));
  const auto claimed = static_cast<std::int64_t>(spec.image_bytes(true));
  if (error || claimed > size * kMostCompression) refuse(path, "it is too short for the size that it claims");
}

/// Only these two formats of the many that OpenImageIO would open.
bool starts_like_png_or_exr(const std::filesystem::path& path) {
  constexpr std::string_view kPng("\x89PNG\r\n\x1a\n", 8);
  constexpr std::string_view kExr("\x76\x2f\x31\x01", 4);
  std::array<char, 8> head{};
  std::ifstream(path, std::ios::binary).read(head.data(), head.size());
  const std::string_view start(head.data(), head.size());
  return start.starts_with(kPng) || start.starts_with(kExr);
}

template <typename Pixel>
std::vector<Pixel> pixels_of(const std::filesystem::path& path, OIIO::ImageInput& in, OIIO::TypeDesc type) {
  const OIIO::ImageSpec& spec = in.spec();
  std::vector<Pixel> pixels(static_cast<std::size_t>(spec.width) * spec.height * spec.nchannels);
  if (!in.read_image(0, 0, 0, spec.nchannels, type, pixels.data())) {
    refuse(path, "its texels can't be read: " + in.geterror());
  }
  return pixels;
}

}  // namespace

std::vector<std::uint8_t> png_of(const BakedMap& map, int bits, NormalY normal_y) {
  if (bits != 8 && bits != 16) {
    throw Error(ExitCode::kUsage, fmt::format("a PNG has 8 or 16 bits a channel, not {}", bits));
  }
  if (!fits_integers(traits_of(map.kind))) {
    throw Error(ExitCode::kUsage, fmt::format("a {} map doesn't fit into a PNG, whose texels end at 1; write an .exr",
                                              traits_of(map.kind).name));
  }
  const bool has_y = holds_tangent_space_normals(traits_of(map.kind));
  if (map.png && map.png->bits == bits && (!has_y || map.png->normal_y == normal_y)) return map.png->bytes;
  return is_turned(map, normal_y) ? encoded_png(turned(map), bits, normal_y) : encoded_png(map, bits, NormalY::kUp);
}

BakedMap as_stored(BakedMap map, bool is_png, int bits, NormalY normal_y) {
  if (!is_png) return map;
  auto png = std::make_shared<const EncodedMap>(EncodedMap{bits, normal_y, png_of(map, bits, normal_y)});
  const MapTraits& traits = traits_of(map.kind);
  const bool turn = is_turned(map, normal_y);
  if (turn) map = turned(std::move(map));
  if (bits == 8) round_to_steps<std::uint8_t>(traits, map.channels, map.texels);
  else round_to_steps<std::uint16_t>(traits, map.channels, map.texels);
  if (turn) map = turned(std::move(map));
  map.png = std::move(png);
  return map;
}

void write_map(const std::filesystem::path& path, const BakedMap& map, int bits, NormalY normal_y) {
  std::vector<std::uint8_t> bytes;
  if (path.extension() == ".png") {
    bytes = png_of(map, bits, normal_y);
  } else if (path.extension() == ".exr") {
    if (bits != 16 && bits != 32) {
      throw Error(ExitCode::kUsage, fmt::format("{}: an EXR has 16 or 32 bits a channel, not {}", path.string(), bits));
    }
    bytes = is_turned(map, normal_y) ? encoded_exr(turned(map), bits, normal_y) : encoded_exr(map, bits, NormalY::kUp);
  } else {
    throw Error(ExitCode::kUsage, path.string() + ": a map is written as .png or .exr; choose one of them");
  }
  write_file_whole(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

BakedMap read_map(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) refuse(path, "there is no such file");
  if (!starts_like_png_or_exr(path)) refuse(path, "it is neither a PNG nor an EXR");
  if (const auto defect = find_picture_defect(path)) refuse(path, *defect);
  OIIO::ImageSpec config;
  config.attribute("oiio:UnassociatedAlpha", 1);
  const std::unique_ptr<OIIO::ImageInput> in = OIIO::ImageInput::open(path.string(), &config);
  if (!in) refuse(path, "it is no picture that can be read: " + OIIO::geterror());
  const OIIO::ImageSpec& spec = in->spec();
  require_plausible_size(path, spec);
  const std::string description = spec.get_string_attribute("ImageDescription");
  std::optional<BakedMap> map = described_map(description, spec.width, spec.height);
  if (!map)
    refuse(path, fmt::format("its description tells of no baked map that fits its {} x {} texels ('{:.80}')",
                             spec.width, spec.height, description));
  if (!may_have_channels(traits_of(map->kind), spec.nchannels)) {
    refuse(path, fmt::format("it has {} channels, and a map of this kind has {}", spec.nchannels, map->channels));
  }
  map->channels = spec.nchannels;
  if (spec.format == OIIO::TypeDesc::UINT8) {
    map->texels =
        values_of(traits_of(map->kind), map->channels, pixels_of<std::uint8_t>(path, *in, OIIO::TypeDesc::UINT8));
  } else if (spec.format == OIIO::TypeDesc::UINT16) {
    map->texels =
        values_of(traits_of(map->kind), map->channels, pixels_of<std::uint16_t>(path, *in, OIIO::TypeDesc::UINT16));
  } else {
    map->texels = pixels_of<float>(path, *in, OIIO::TypeDesc::FLOAT);
  }
  for (const float value : map->texels) {
    if (!std::isfinite(value)) refuse(path, "it holds texels that are no numbers");
  }
  return is_turned(*map, described_normal_y(description)) ? turned(*std::move(map)) : *std::move(map);
}

}  // namespace lozenge
