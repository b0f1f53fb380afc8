// The patches packed in an atlas, with their levels of detail and their adjacency (paper, Sec. 6.0.1 and Fig. 7).
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "formats/base/vector.h"
#include "formats/patches/patch_layout.h"
#include "formats/surface/attribute.h"

namespace lozenge {

/// One level of detail: every 2^level-th sample of the patches that exist on it, tile by tile. In the picture patch p
/// is the tile in column p % columns and row p / columns, each tile `samples` texels square; tiles past the last patch
/// hold zeros.
struct GeometryLevel {
  std::int32_t samples = 0;  ///< a side, (N - 1) / 2^level + 1
  std::int32_t rows = 0;     ///< of tiles: those that hold the patches of the level
  /// [texel of the picture, row by row from the top]; the picture is columns * samples wide, rows * samples high.
  /// Row j of a tile is v = j / (samples - 1): v runs down the picture.
  std::vector<Vec3f> positions;
  std::vector<Vec3f> normals;
  /// 1 where a sample lies on the cap of a hole that the importer filled, else 0; empty where no sample of the image
  /// does.
  std::vector<std::uint32_t> caps;
  /// Elements of `kInfluences`, one for each texel; empty where no body of the image has a skin.
  std::vector<float> influences;
};

/// A packed geometry image. Level 0 is the finest; the last has 2 samples a side (the patches' corners).
///
/// A part whose first level is k exists from level k on. Where a finer level is drawn, its patches are drawn as on
/// level k: `shown` leads to them.
struct GeometryImage {
  PatchLayout layout;        ///< its samples are those of level 0
  std::int32_t columns = 0;  ///< tiles side by side
  std::vector<GeometryLevel> levels;

  std::int32_t size() const { return layout.size(); }
  bool has_caps() const { return !levels.empty() && !levels.front().caps.empty(); }
  bool has_influences() const { return !levels.empty() && !levels.front().influences.empty(); }
  std::int32_t width(const GeometryLevel& level) const { return columns * level.samples; }
  static std::int32_t height(const GeometryLevel& level) { return level.rows * level.samples; }
  /// Rows of tiles of a level.
  std::int32_t rows_on(std::int32_t level) const {
    return std::max(1, (layout.count_on(level) + columns - 1) / columns);
  }
  /// A level of zeros, its caps without marks or empty, and its joints.
  GeometryLevel empty_level(std::int32_t level, bool with_caps, bool with_influences = false) const {
    GeometryLevel made{((layout.samples - 1) >> level) + 1, rows_on(level), {}, {}, {}, {}};
    made.positions.assign(static_cast<std::size_t>(width(made)) * height(made), Vec3f(0, 0, 0));
    made.normals = made.positions;
    if (with_caps) made.caps.assign(made.positions.size(), 0);
    if (with_influences) made.influences.assign(kInfluences.components * made.positions.size(), 0);
    return made;
  }
  /// Index of sample (i, j) of a patch in a level's arrays. \pre the patch exists on the level
  std::size_t index(const GeometryLevel& level, std::int32_t patch, std::int32_t i, std::int32_t j) const {
    const auto x = static_cast<std::size_t>(patch % columns) * level.samples + i;
    const auto y = static_cast<std::size_t>(patch / columns) * level.samples + j;
    return y * width(level) + x;
  }
  /// Sample (i, j) of a patch where `level` is drawn.
  const Vec3f& position(std::int32_t level, std::int32_t patch, std::int32_t i, std::int32_t j) const {
    const GeometryLevel& of = shown(level, patch);
    return of.positions[index(of, patch, i, j)];
  }
  const Vec3f& normal(std::int32_t level, std::int32_t patch, std::int32_t i, std::int32_t j) const {
    const GeometryLevel& of = shown(level, patch);
    return of.normals[index(of, patch, i, j)];
  }
  /// Whether it lies on a cap.
  bool on_cap(std::int32_t level, std::int32_t patch, std::int32_t i, std::int32_t j) const {
    const GeometryLevel& of = shown(level, patch);
    return !of.caps.empty() && of.caps[index(of, patch, i, j)] != 0;
  }
  /// What moves it, an element of `kInfluences`. \pre the image has them
  const float* influence(std::int32_t level, std::int32_t patch, std::int32_t i, std::int32_t j) const {
    const GeometryLevel& of = shown(level, patch);
    return &of.influences[kInfluences.components * index(of, patch, i, j)];
  }

 private:
  const GeometryLevel& shown(std::int32_t level, std::int32_t patch) const {
    return levels[layout.shown_level(patch, level)];
  }
};

}  // namespace lozenge
