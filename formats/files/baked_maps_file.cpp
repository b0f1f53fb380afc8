// OpenImageIO encodes and decodes the pixels; what a map is beyond its pixels stands in one text field. A file is not
// believed before its own description, its size and its channels agree.
#include "formats/files/baked_maps_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <fstream>
#include <limits>
#include <memory>
#include <optional>
#include <string_view>
#include <system_error>

#include "formats/base/atomic_file.h"
#include "formats/base/error.h"
#include "formats/files/openimageio.h"
#include "formats/files/picture_check.h"
#include "formats/files/png_file.h"

namespace lozenge {

namespace {

/// No file of PNG or EXR holds more bytes of pixels than this for each byte of its own: the limit of the deflate
/// format, with some room. More is claimed by files that want our memory.
constexpr std::int64_t kMostCompression = 1100;

/// More tiles of one size are no texture.
constexpr std::int32_t kMostTiles = 1 << 26;

std::string description_of(const BakedMap& map) {
  const MapLayout& layout = map.layout;
  std::string text =
      fmt::format("lozenge {} columns={} rows={} tile={} gutter={} shrink={} level={}", traits_of(map.kind).name,
                  layout.columns, layout.rows(), layout.tile, layout.gutter, map.shrink, map.level);
  for (std::size_t k = 0; k < layout.counts.size(); ++k) text += fmt::format(" tiles{}={}", k, layout.counts[k]);
  return text;
}

/// The steps of an integer channel that are nearest to the map's values.
template <typename Step>
std::vector<Step> quantized(const BakedMap& map) {
  constexpr double kMost = std::numeric_limits<Step>::max();
  const MapTraits& traits = traits_of(map.kind);
  std::vector<Step> steps(map.texels.size());
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const auto channel = static_cast<std::int32_t>(i % map.channels);
    steps[i] = static_cast<Step>(std::lround(stored_share(traits, channel, map.texels[i]) * kMost));
  }
  return steps;
}

/// What the steps mean; quantized again, they give the same steps.
template <typename Step>
std::vector<float> values_of(const std::vector<Step>& steps, const BakedMap& map) {
  const MapTraits& traits = traits_of(map.kind);
  constexpr double kMost = std::numeric_limits<Step>::max();
  std::vector<float> values(steps.size());
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const auto channel = static_cast<std::int32_t>(i % map.channels);
    values[i] = static_cast<float>(value_of_share(traits, channel, steps[i] / kMost));
  }
  return values;
}

std::vector<std::uint8_t> encoded_exr(const BakedMap& map, int bits) {
  OIIO::ImageSpec spec(map.width(), map.height(), map.channels,
                       bits == 16 ? OIIO::TypeDesc::HALF : OIIO::TypeDesc::FLOAT);
  spec.attribute("ImageDescription", description_of(map));
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

std::vector<std::uint8_t> encoded_png(const BakedMap& map, int bits) {
  const PngPicture picture{map.width(), map.height(), map.channels, bits, false, description_of(map)};
  if (bits == 8) return png_file(picture, quantized<std::uint8_t>(map));
  std::vector<std::uint8_t> bytes;
  for (const std::uint16_t step : quantized<std::uint16_t>(map)) {
    bytes.push_back(static_cast<std::uint8_t>(step >> 8));
    bytes.push_back(static_cast<std::uint8_t>(step & 0xFF));
  }
  return png_file(picture, bytes);
}

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& reason) {
  throw Error(ExitCode::kUnusableInput, fmt::format("{}: {}; bake it again", path.string(), reason));
}

/// The number after " key=", if it is a whole number from `least` to `most`.
std::optional<std::int32_t> field(std::string_view text, std::string_view key, std::int32_t least, std::int32_t most) {
  const std::string pattern = fmt::format(" {}=", key);
  const std::size_t at = text.find(pattern);
  if (at == std::string_view::npos) return std::nullopt;
  const std::string_view rest = text.substr(at + pattern.size());
  std::int32_t value = 0;
  const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), value);
  const bool whole = error == std::errc() && (end == rest.data() + rest.size() || *end == ' ');
  return whole && value >= least && value <= most ? std::optional(value) : std::nullopt;
}

/// How many tiles of each size the description tells of; one that tells of none is of the format's first version, with
/// as many of one size as fit. Nothing where that makes no sense.
std::optional<std::array<std::int32_t, kMostFirstLevel + 1>> counts_in(std::string_view text, std::int64_t cells) {
  std::array<std::int32_t, kMostFirstLevel + 1> counts{};
  if (text.find(" tiles0=") == std::string_view::npos) {
    if (cells > kMostTiles) return std::nullopt;
    counts[0] = static_cast<std::int32_t>(cells);
    return counts;
  }
  for (std::size_t k = 0; k < counts.size(); ++k) {
    const auto count = field(text, fmt::format("tiles{}", k), 0, kMostTiles);
    if (!count) return std::nullopt;
    counts[k] = *count;
  }
  return counts;
}

/// Tiles lie inside of the texture, and halve as often as the smallest of them asks for.
bool is_sound(const MapLayout& layout) {
  if (layout.patches() < 1 || layout.rows() < 1) return false;
  const std::int32_t smallest = layout.smallest_tile();
  return smallest >= 1 && layout.tile % smallest == 0 &&
         std::has_single_bit(static_cast<std::uint32_t>(layout.tile / smallest)) &&
         smallest - 2 * layout.gutter_of(smallest) >= 2 && std::int64_t{layout.columns} * layout.tile <= layout.width &&
         std::int64_t{layout.rows()} * layout.tile <= layout.height;
}

/// The map that the description tells of, still without texels.
std::optional<BakedMap> parsed(std::string_view text, std::int32_t width, std::int32_t height) {
  BakedMap map;
  const auto traits = std::find_if(kMapKinds.begin(), kMapKinds.end(), [&](const MapTraits& t) {
    return text.substr(0, text.find(" columns=")) == fmt::format("lozenge {}", t.name);
  });
  if (traits == kMapKinds.end()) return std::nullopt;
  const auto columns = field(text, "columns", 1, kMostMapSize);
  const auto rows = field(text, "rows", 1, kMostMapSize);
  const auto tile = field(text, "tile", 1, kMostMapSize);
  const auto gutter = field(text, "gutter", 0, kMostMapSize);
  const auto shrink = field(text, "shrink", 1, kMostMapSize);
  const auto level = field(text, "level", 0, 31);
  if (!columns || !rows || !tile || !gutter || !shrink || !level) return std::nullopt;
  const std::int64_t whole_width = std::int64_t{width} * *shrink;
  const std::int64_t whole_height = std::int64_t{height} * *shrink;
  const auto counts = counts_in(text, std::int64_t{*columns} * *rows);
  if (!counts || whole_width > kMostMapSize || whole_height > kMostMapSize) return std::nullopt;
  map.layout = {static_cast<std::int32_t>(whole_width),
                static_cast<std::int32_t>(whole_height),
                *columns,
                *tile,
                *gutter,
                *counts};
  if (!is_sound(map.layout) || map.layout.rows() != *rows) return std::nullopt;
  map.kind = traits->kind;
  map.channels = traits->channels;
  map.shrink = *shrink;
  map.level = *level;
  return map;
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

std::vector<std::uint8_t> png_of(const BakedMap& map, int bits) {
  if (bits != 8 && bits != 16) {
    throw Error(ExitCode::kUsage, fmt::format("a PNG has 8 or 16 bits a channel, not {}", bits));
  }
  if (!fits_integers(traits_of(map.kind))) {
    throw Error(ExitCode::kUsage, fmt::format("a {} map doesn't fit into a PNG, whose texels end at 1; write an .exr",
                                              traits_of(map.kind).name));
  }
  if (map.png && map.png->bits == bits) return map.png->bytes;
  return encoded_png(map, bits);
}

BakedMap as_stored(const BakedMap& map, bool is_png, int bits) {
  BakedMap stored = map;
  if (!is_png) return stored;
  stored.png = std::make_shared<const EncodedMap>(EncodedMap{bits, png_of(map, bits)});
  stored.texels =
      bits == 8 ? values_of(quantized<std::uint8_t>(map), map) : values_of(quantized<std::uint16_t>(map), map);
  return stored;
}

void write_map(const std::filesystem::path& path, const BakedMap& map, int bits) {
  std::vector<std::uint8_t> bytes;
  if (path.extension() == ".png") {
    bytes = png_of(map, bits);
  } else if (path.extension() == ".exr") {
    if (bits != 16 && bits != 32) {
      throw Error(ExitCode::kUsage, fmt::format("{}: an EXR has 16 or 32 bits a channel, not {}", path.string(), bits));
    }
    bytes = encoded_exr(map, bits);
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
  std::optional<BakedMap> map = parsed(description, spec.width, spec.height);
  if (!map)
    refuse(path, fmt::format("its description tells of no baked map that fits its {} x {} texels ('{:.80}')",
                             spec.width, spec.height, description));
  if (!may_have_channels(traits_of(map->kind), spec.nchannels)) {
    refuse(path, fmt::format("it has {} channels, and a map of this kind has {}", spec.nchannels, map->channels));
  }
  map->channels = spec.nchannels;
  if (spec.format == OIIO::TypeDesc::UINT8) {
    map->texels = values_of(pixels_of<std::uint8_t>(path, *in, OIIO::TypeDesc::UINT8), *map);
  } else if (spec.format == OIIO::TypeDesc::UINT16) {
    map->texels = values_of(pixels_of<std::uint16_t>(path, *in, OIIO::TypeDesc::UINT16), *map);
  } else {
    map->texels = pixels_of<float>(path, *in, OIIO::TypeDesc::FLOAT);
  }
  for (const float value : map->texels) {
    if (!std::isfinite(value)) refuse(path, "it holds texels that are no numbers");
  }
  return *std::move(map);
}

}  // namespace lozenge
