#include "formats/files/map_mips_file.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "formats/base/atomic_file.h"
#include "formats/base/error.h"
#include "formats/base/parallel.h"
#include "formats/files/ktx2_file.h"
#include "formats/files/map_description.h"
#include "formats/files/map_steps.h"

namespace lozenge {

namespace {

TexelFormat format_of(const BakedMap& map, int bits) {
  if (map.channels == 1) return TexelFormat::kR8;
  if (bits == 16) return TexelFormat::kRgba16;
  return traits_of(map.kind).colours == ColourSpace::kSrgb ? TexelFormat::kRgba8Srgb : TexelFormat::kRgba8;
}

template <typename Step>
std::vector<std::uint8_t> level_of(const BakedMap& map, TexelFormat format, const std::vector<float>& texels) {
  const std::vector<Step> steps = quantized<Step>(traits_of(map.kind), map.channels, texels);
  const auto had = static_cast<std::size_t>(map.channels);
  const auto wanted = static_cast<std::size_t>(texel_channels(format));
  std::vector<std::uint8_t> bytes;
  bytes.reserve(steps.size() / had * wanted * sizeof(Step));
  for (std::size_t texel = 0; texel < steps.size() / had; ++texel) {
    for (std::size_t c = 0; c < wanted; ++c) {
      const Step step = c < had ? steps[texel * had + c] : c == 3 ? std::numeric_limits<Step>::max() : Step{0};
      for (std::size_t k = 0; k < sizeof step; ++k) bytes.push_back(static_cast<std::uint8_t>(step >> (8 * k)));
    }
  }
  return bytes;
}

template <typename Step>
std::vector<float> texels_of(const BakedMap& map, TexelFormat format, const std::vector<std::uint8_t>& bytes) {
  const auto wanted = static_cast<std::size_t>(map.channels);
  const auto stored = static_cast<std::size_t>(texel_channels(format));
  const std::size_t count = bytes.size() / (stored * sizeof(Step));
  std::vector<Step> steps;
  steps.reserve(count * wanted);
  for (std::size_t texel = 0; texel < count; ++texel) {
    for (std::size_t c = 0; c < wanted; ++c) {
      Step step = 0;
      for (std::size_t k = 0; k < sizeof step; ++k) {
        step = static_cast<Step>(step | bytes[(texel * stored + c) * sizeof step + k] << (8 * k));
      }
      steps.push_back(step);
    }
  }
  return values_of<Step>(traits_of(map.kind), map.channels, steps);
}

}  // namespace

void write_map_mips(const std::filesystem::path& path, const BakedMap& map, const std::vector<MipLevel>& mips,
                    int bits) {
  if (bits != 8 && bits != 16) {
    throw Error(ExitCode::kUsage, fmt::format("{}: a texture has 8 or 16 bits a channel, not {}", path.string(), bits));
  }
  Ktx2Texture texture{format_of(map, bits), map.width(), map.height(), {}, map_description(map)};
  texture.levels.resize(mips.size() + 1);
  for_each_index(texture.levels.size(), true, [&](std::size_t l) {
    const std::vector<float>& texels = l == 0 ? map.texels : mips[l - 1].texels;
    texture.levels[l] = texture.format == TexelFormat::kRgba16 ? level_of<std::uint16_t>(map, texture.format, texels)
                                                               : level_of<std::uint8_t>(map, texture.format, texels);
  });
  const std::vector<std::uint8_t> bytes = ktx2_of(texture);
  write_file_whole(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

MapMips read_map_mips(const std::filesystem::path& path) {
  const Ktx2Texture texture = read_ktx2(path, kMostMapSize);
  std::optional<BakedMap> map = described_map(texture.description, texture.width, texture.height);
  const int bits = texture.format == TexelFormat::kRgba16 ? 16 : 8;
  if (!map || !fits_integers(traits_of(map->kind)) || format_of(*map, bits) != texture.format) {
    throw Error(
        ExitCode::kUnusableInput,
        fmt::format("{}: its description tells of no baked map that fits its {} x {} texels ('{:.80}'); bake it "
                    "again",
                    path.string(), texture.width, texture.height, texture.description));
  }
  MapMips read{*std::move(map), bits, {}};
  for (std::size_t l = 0; l < texture.levels.size(); ++l) {
    std::vector<float> texels = bits == 16 ? texels_of<std::uint16_t>(read.map, texture.format, texture.levels[l])
                                           : texels_of<std::uint8_t>(read.map, texture.format, texture.levels[l]);
    if (l == 0) {
      read.map.texels = std::move(texels);
      continue;
    }
    read.mips.push_back({std::max(texture.width >> l, 1), std::max(texture.height >> l, 1), std::move(texels)});
  }
  return read;
}

}  // namespace lozenge
