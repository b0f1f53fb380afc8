// Items that are seen together get different colours, greedily, in their order.
#include "stages/render/palette.h"

#include <iterator>

namespace lozenge {

namespace {

/// Chosen by eye: light enough to show shading, far enough apart to tell neighbours from each other.
constexpr std::uint32_t kPalette[] = {0x5E97D0, 0xF0A04B, 0x74B56F, 0xD5655D, 0x9B7EC0, 0xE7CF66, 0x4FB0A8, 0xE596BA,
                                      0xB9875F, 0xA9C765, 0x7F93B2, 0xF2B8A2, 0x5FA3B5, 0xC7B5E0, 0x9C9A8C};
constexpr std::int32_t kColours = static_cast<std::int32_t>(std::size(kPalette));

}  // namespace

Vec3f clay() { return srgb(0xC9C1B6); }

Vec3f patch_colour(std::int32_t index) { return srgb(kPalette[((index % kColours) + kColours) % kColours]); }

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
