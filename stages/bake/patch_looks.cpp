// Four look-ups a cell, each filtered over a quarter of it, are added up in linear light, as mips do.
#include "stages/bake/patch_looks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "formats/base/parallel.h"

namespace lozenge {

namespace {

/// Look-ups along a side of a cell, and of a patch.
constexpr std::int32_t kOfCell = 2;
constexpr std::int32_t kOfPatch = kOfCell * kLookCells;

/// What differences in roughness, metal and occlusion count beside those in colours.
constexpr double kOfShading = 0.5;

/// Sums of linear numbers.
struct LinearLook {
  Vec4d colour{0, 0, 0, 0};  ///< multiplied by alpha, and alpha
  Vec3d shading{0, 0, 0};
  double glow = 0;

  void add(const SourceLook& look, const SourceFootprint& place) {
    constexpr double kShare = 1.0 / (kOfCell * kOfCell);
    const Vec4d seen = look.base_colour(place);
    colour += Vec4d(seen.x * seen.w, seen.y * seen.w, seen.z * seen.w, seen.w) * kShare;
    shading += look.occlusion_roughness_metal(place) * kShare;
    const Vec3d light = look.emissive(place);
    glow += (light.x + light.y + light.z) / 3 * kShare;
  }

  /// Square roots are about what sRGB makes of linear numbers.
  Look as_seen() const {
    const auto number = [](double value) { return static_cast<float>(std::clamp(value, 0.0, 1.0)); };
    return {number(std::sqrt(std::max(colour.x, 0.0))),
            number(std::sqrt(std::max(colour.y, 0.0))),
            number(std::sqrt(std::max(colour.z, 0.0))),
            number(colour.w),
            number(kOfShading * shading.x),
            number(kOfShading * shading.y),
            number(kOfShading * shading.z),
            number(std::sqrt(std::max(glow, 0.0)))};
  }
};

}  // namespace

std::vector<PatchLook> looks_of_patches(const PatchLayout& patches, const Projector& projector,
                                        const SourceLook& look) {
  std::vector<PatchLook> looks(static_cast<std::size_t>(patches.size()));
  for_each_index(looks.size(), true, [&](std::size_t p) {
    const bool half = !patches.places[p].right.exists();
    std::array<LinearLook, kLookCells * kLookCells> cells;
    for (std::int32_t j = 0; j < kOfPatch; ++j) {
      for (std::int32_t i = 0; i < kOfPatch; ++i) {
        double u = (i + 0.5) / kOfPatch;
        double v = (j + 0.5) / kOfPatch;
        if (half && u > v) std::swap(u, v);
        const LocatedPoint at = projector.locate(static_cast<std::int32_t>(p), u, v);
        cells[i / kOfCell + kLookCells * (j / kOfCell)].add(look,
                                                            {at.point, at.along_u / kOfPatch, at.along_v / kOfPatch});
      }
    }
    for (std::size_t c = 0; c < cells.size(); ++c) looks[p][c] = cells[c].as_seen();
  });
  return looks;
}

}  // namespace lozenge
