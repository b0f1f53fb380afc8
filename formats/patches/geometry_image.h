// The patches packed in an atlas, with their levels of detail and their adjacency (paper, Sec. 6.0.1 and Fig. 7).
#pragma once

#include <cstdint>
#include <vector>

#include "formats/base/vector.h"
#include "formats/patches/patch_layout.h"

namespace lozenge {

/// One level of detail: every 2^level-th sample of the patches, tile by tile. In the picture patch p is the tile in
/// column p % columns and row p / columns, each tile `samples` texels square; tiles past the last patch hold zeros.
struct GeometryLevel {
  std::int32_t samples = 0;  ///< a side, (N - 1) / 2^level + 1
  /// [texel of the picture, row by row from the top]; the picture is columns * samples wide, rows * samples high.
  /// Row j of a tile is v = j / (samples - 1): v runs down the picture.
  std::vector<Vec3f> positions;
  std::vector<Vec3f> normals;
};

/// A packed geometry image. Level 0 is the finest; the last has 2 samples a side (the patch's corners).
struct GeometryImage {
  PatchLayout layout;        ///< its samples are those of level 0
  std::int32_t columns = 0;  ///< tiles side by side
  std::int32_t rows = 0;
  std::vector<GeometryLevel> levels;
  /// [texel of level 0] 1 where a sample lies on the cap of a hole that the importer filled, else 0; empty where none
  /// does.
  std::vector<std::uint32_t> caps;

  std::int32_t size() const { return layout.size(); }
  std::int32_t width(const GeometryLevel& level) const { return columns * level.samples; }
  std::int32_t height(const GeometryLevel& level) const { return rows * level.samples; }
  /// Index of sample (i, j) of a patch in a level's arrays.
  std::size_t index(const GeometryLevel& level, std::int32_t patch, std::int32_t i, std::int32_t j) const {
    const auto x = static_cast<std::size_t>(patch % columns) * level.samples + i;
    const auto y = static_cast<std::size_t>(patch / columns) * level.samples + j;
    return y * width(level) + x;
  }
  /// Whether sample (i, j) of a patch, on this level of detail, lies on a cap.
  bool on_cap(int level, std::int32_t patch, std::int32_t i, std::int32_t j) const {
    return !caps.empty() && caps[index(levels.front(), patch, i << level, j << level)] != 0;
  }
};

}  // namespace lozenge
