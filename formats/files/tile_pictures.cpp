// OpenImageIO encodes the pixels.
#include "formats/files/tile_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "formats/base/atomic_file.h"
#include "formats/base/error.h"
#include "formats/files/openimageio.h"

namespace lozenge {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kMost = 65535;

struct Tiles {
  std::int64_t count = 0;
  std::int64_t side = 0;
  std::int64_t channels = 1;
  std::int64_t columns = 1;

  explicit Tiles(const std::vector<std::int64_t>& shape)
      : count(shape[0]), side(shape[1]), channels(shape.size() > 3 ? shape[3] : 1) {
    while (columns * columns < count) ++columns;
  }
  std::int64_t rows() const { return (count + columns - 1) / columns; }
};

/// Whether numbers are integers that want 32 bits.
bool is_wide(const NamedArray& array) {
  return array.shape.size() == 3 && std::holds_alternative<std::vector<std::int32_t>>(array.values);
}

std::uint16_t step_of(double value, const std::array<double, 2>& range) {
  if (range[1] <= range[0]) return 0;
  const double share = (value - range[0]) / (range[1] - range[0]);
  return static_cast<std::uint16_t>(std::lround(std::clamp(share, 0.0, 1.0) * kMost));
}

/// Number n of the array.
double number(const NamedArray& array, std::size_t n) {
  if (const auto* floats = std::get_if<std::vector<float>>(&array.values)) return (*floats)[n];
  if (const auto* doubles = std::get_if<std::vector<double>>(&array.values)) return (*doubles)[n];
  if (const auto* integers = std::get_if<std::vector<std::int32_t>>(&array.values)) return (*integers)[n];
  return std::get<Truths>(array.values).bytes[n];
}

/// The pixels, row by row. \param channels  of the picture
std::vector<std::uint16_t> pixels_of(const NamedArray& array, const Tiles& tiles, std::int64_t channels) {
  const std::int64_t width = tiles.columns * tiles.side;
  std::vector<std::uint16_t> pixels(static_cast<std::size_t>(width * tiles.rows() * tiles.side * channels));
  std::size_t n = 0;
  for (std::int64_t patch = 0; patch < tiles.count; ++patch) {
    for (std::int64_t row = 0; row < tiles.side; ++row) {
      const std::int64_t y = patch / tiles.columns * tiles.side + row;
      std::uint16_t* to =
          &pixels[static_cast<std::size_t>((y * width + patch % tiles.columns * tiles.side) * channels)];
      for (std::int64_t k = 0; k < tiles.side; ++k, to += channels) {
        if (is_wide(array)) {
          const auto code = static_cast<std::uint32_t>(std::get<std::vector<std::int32_t>>(array.values)[n++]) + 1;
          to[0] = static_cast<std::uint16_t>(code >> 16);
          to[1] = static_cast<std::uint16_t>(code & 0xFFFF);
          continue;
        }
        for (std::int64_t c = 0; c < tiles.channels; ++c) to[c] = step_of(number(array, n++), array.ranges[c]);
      }
    }
  }
  return pixels;
}

void write_png(const std::filesystem::path& path, const NamedArray& array, const Tiles& tiles) {
  // There is no PNG of two channels but grey and alpha, which many programs multiply.
  const std::int64_t channels = is_wide(array) || tiles.channels == 2 ? 3 : tiles.channels;
  const std::vector<std::uint16_t> pixels = pixels_of(array, tiles, channels);
  OIIO::ImageSpec spec(static_cast<int>(tiles.columns * tiles.side), static_cast<int>(tiles.rows() * tiles.side),
                       static_cast<int>(channels), OIIO::TypeDesc::UINT16);
  spec.attribute("ImageDescription", "lozenge array " + array.name);
  if (channels == 4) spec.attribute("oiio:UnassociatedAlpha", 1);
  std::vector<std::uint8_t> bytes;
  OIIO::Filesystem::IOVecOutput memory(bytes);
  const auto out = OIIO::ImageOutput::create("png");
  const bool is_written = out && out->set_ioproxy(&memory) && out->open("array.png", spec) &&
                          out->write_image(OIIO::TypeDesc::UINT16, pixels.data()) && out->close();
  if (!is_written) {
    throw Error(ExitCode::kInternal, fmt::format("OpenImageIO can't make a PNG of {}: {}", array.name,
                                                 out ? out->geterror() : OIIO::geterror()));
  }
  write_file_whole(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

}  // namespace

void write_tile_pictures(const std::filesystem::path& json, const std::string& geometry_image,
                         const std::vector<NamedArray>& arrays) {
  Json pictures = Json::array();
  for (const NamedArray& array : arrays) {
    if (array.ranges.empty() || array.shape[0] == 0) continue;
    const Tiles tiles(array.shape);
    const std::string file = fmt::format("{}.{}.png", json.stem().string(), array.name);
    write_png(json.parent_path() / file, array, tiles);
    Json picture{{"array", array.name}, {"file", file}, {"shape", array.shape}, {"columns", tiles.columns}};
    if (is_wide(array)) {
      picture["integers"] = "65536 * red + green - 1";
    } else {
      picture["ranges"] = array.ranges;
    }
    pictures.push_back(std::move(picture));
  }
  const Json all{{"kind", "geometry image as pictures"},
                 {"version", 1},
                 {"geometry_image", Json::parse(geometry_image)},
                 {"pictures", std::move(pictures)}};
  write_file_whole(json, all.dump(1) + "\n");
}

}  // namespace lozenge
