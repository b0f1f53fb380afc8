#include "stages/render/palette.h"

#include <algorithm>
#include <cmath>

namespace lozenge {

namespace {

constexpr std::int32_t kColours = 15;

/// Bjoern Ottosson's OKLCH: lightness and chroma as seen, hue in turns. Gives linear RGB.
Vec3f oklch(double lightness, double chroma, double hue) {
  const double angle = 2 * 3.14159265358979323846 * hue;
  const double a = chroma * std::cos(angle);
  const double b = chroma * std::sin(angle);
  const double l = std::pow(lightness + 0.3963377774 * a + 0.2158037573 * b, 3);
  const double m = std::pow(lightness - 0.1055613458 * a - 0.0638541728 * b, 3);
  const double s = std::pow(lightness - 0.0894841775 * a - 1.2914855480 * b, 3);
  const Vec3d rgb(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
                  -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
                  -0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s);
  Vec3f clamped;
  for (int c = 0; c < 3; ++c) clamped[c] = static_cast<float>(std::clamp(rgb[c], 0.0, 1.0));
  return clamped;
}

}  // namespace

Vec3f clay() { return srgb(0xC9C1B6); }

Vec3f patch_colour(std::int32_t index) {
  const std::int32_t i = ((index % kColours) + kColours) % kColours;
  // Hues a seventh-and-a-bit apart, so that successive indices differ much; lightness in three steps.
  const double hue = std::fmod(0.07 + i * 7.0 / kColours, 1.0);
  static constexpr double kLightness[] = {0.76, 0.68, 0.83};
  static constexpr double kChroma[] = {0.105, 0.115, 0.085};
  return oklch(kLightness[i % 3], kChroma[i % 3], hue);
}

std::vector<std::int32_t> colour_items(std::int32_t items, const std::vector<std::vector<std::int32_t>>& groups) {
  std::vector<std::vector<std::int32_t>> groups_of(static_cast<std::size_t>(items));
  for (std::size_t g = 0; g < groups.size(); ++g) {
    for (const std::int32_t item : groups[g]) groups_of[item].push_back(static_cast<std::int32_t>(g));
  }
  std::vector<std::int32_t> colour(static_cast<std::size_t>(items), -1);
  for (std::int32_t item = 0; item < items; ++item) {
    std::vector<bool> taken(kColours, false);
    for (const std::int32_t g : groups_of[item]) {
      for (const std::int32_t other : groups[g]) {
        if (colour[other] >= 0) taken[colour[other]] = true;
      }
    }
    // Each item starts its search elsewhere. Where all are taken (a vertex of many triangles), the start is as good as
    // any.
    const std::int32_t start = item * 4 % kColours;
    colour[item] = start;
    for (std::int32_t k = 0; k < kColours; ++k) {
      const std::int32_t candidate = (start + k) % kColours;
      if (taken[candidate]) continue;
      colour[item] = candidate;
      break;
    }
  }
  return colour;
}

}  // namespace lozenge
