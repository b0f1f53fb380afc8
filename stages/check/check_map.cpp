#include "stages/check/check_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "stages/check/finding.h"

namespace lozenge {

namespace {

bool check_layout(const BakedMap& map, CheckReport& report) {
  const MapLayout& l = map.layout;
  const bool tiles_fit = l.columns > 0 && l.tile > 0 && l.gutter >= 0 && l.patches() > 0 &&
                         l.smallest_tile() - 2 * l.gutter_of(l.smallest_tile()) >= 2 &&
                         static_cast<std::int64_t>(l.columns) * l.tile <= l.width &&
                         static_cast<std::int64_t>(l.rows()) * l.tile <= l.height;
  const bool shrinks = map.shrink > 0 && l.width % map.shrink == 0 && l.height % map.shrink == 0;
  const bool complete = tiles_fit && shrinks && map.channels > 0 &&
                        map.texels.size() == static_cast<std::size_t>(map.width()) * map.height() * map.channels;
  report.add("layout of tiles", complete,
             fmt::format("{} x {} texels, {} tiles of {} to {} with a gutter of {}, 1 : {}", l.width, l.height,
                         l.patches(), l.smallest_tile(), l.tile, l.gutter, map.shrink));
  return complete;
}

/// Boxes and look-ups in the mips of a texture mix no two tiles, down to where gutters are too narrow, or, of a texture
/// whose side isn't a multiple, down to where engines round it.
void check_mips_of_tiles(const MapLayout& layout, CheckReport& report) {
  constexpr std::int32_t kLeastAligned = 8;  // smaller ones are for atlases that are nearly too small
  const auto gutter = static_cast<std::uint32_t>(layout.gutter_of(layout.smallest_tile()));
  const auto sides = static_cast<std::uint32_t>(layout.width | layout.height);
  const std::int32_t possible =
      std::min(static_cast<std::int32_t>(std::bit_width(2 * gutter + 1)) - 1, std::countr_zero(sides));
  const std::int32_t mips = layout.clean_mips();
  report.add("mips keep patches apart", layout.tile < kLeastAligned || mips >= possible,
             fmt::format("down to number {}, of texels {} times as wide", mips, 1 << mips));
}

/// Calls f(x, y, texel) for every texel.
template <typename F>
void for_each_texel(const BakedMap& map, const F& f) {
  for (std::int32_t y = 0; y < map.height(); ++y) {
    for (std::int32_t x = 0; x < map.width(); ++x) {
      f(x, y, &map.texels[(static_cast<std::size_t>(y) * map.width() + x) * map.channels]);
    }
  }
}

void check_normals(const BakedMap& map, int bits, CheckReport& report) {
  // Each component is off by half a step of 2 / (2^bits - 1).
  const double step = bits >= 32 ? 0 : 1.01 * std::sqrt(3.0) / (std::pow(2.0, bits) - 1);
  const double tolerance = step + 1e-5;
  const auto& of_kind = traits_of(map.kind).neutral;
  const Vec3d neutral(of_kind[0], of_kind[1], of_kind[2]);
  Finding crooked;
  for_each_texel(map, [&](std::int32_t x, std::int32_t y, const float* texel) {
    const Vec3d n(texel[0], texel[1], texel[2]);
    // Where no patch lies, normals may be zero.
    const bool empty = (n - neutral).length() <= tolerance;
    if (empty || std::abs(n.length() - 1) <= tolerance) return;
    crooked.add([&] { return fmt::format("texel ({}, {}) is {:.5f} long", x, y, n.length()); });
  });
  crooked.report_to(report, "normals are unit vectors", fmt::format("to {:.2g}", tolerance));
}

void check_values(const BakedMap& map, CheckReport& report) {
  Finding wrong;
  const NumberRange range = range_of(traits_of(map.kind).values);
  for_each_texel(map, [&](std::int32_t x, std::int32_t y, const float* texel) {
    for (std::int32_t c = 0; c < map.channels; ++c) {
      const bool fine = std::isfinite(texel[c]) && texel[c] >= range.least - 1e-6F && texel[c] <= range.most + 1e-6F;
      if (!fine) wrong.add([&] { return fmt::format("texel ({}, {}), channel {} is {}", x, y, c, texel[c]); });
    }
  });
  wrong.report_to(report, "values in range",
                  std::isfinite(range.most) ? fmt::format("{} to {}", range.least, range.most) : "finite");
}

}  // namespace

CheckReport check_map(const BakedMap& map, int bits) {
  CheckReport report;
  report.kind = "map";
  if (!check_layout(map, report)) return report;
  check_mips_of_tiles(map.layout, report);
  const MapTraits& traits = traits_of(map.kind);
  report.add("channels of its kind", may_have_channels(traits, map.channels),
             fmt::format("{}, needs {}", map.channels, traits.channels));
  check_values(map, report);
  if (traits.values == MapValues::kDirections && map.channels == 3) check_normals(map, bits, report);
  return report;
}

}  // namespace lozenge
