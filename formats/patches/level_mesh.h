// One level of detail of a geometry image as a watertight triangle mesh (paper, Fig. 6).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "formats/base/vector.h"
#include "formats/patches/geometry_image.h"
#include "formats/patches/patch_grids.h"
#include "formats/patches/patch_set.h"
#include "formats/surface/surface_view.h"

namespace lozenge {

/// Triangles of one level, welded wherever positions have equal bits.
///
/// Triangles come patch by patch, each patch's in the order of `for_each_patch_triangle`, which also says how quads are
/// split.
struct LevelMesh {
  PatchGrids grids;  ///< of the samples that the level draws
  /// [vertex]; vertices are numbered in the order in which samples (patch by patch, row by row) first hold them.
  std::vector<Vec3f> positions;
  /// [triangle], counter-clockwise seen from outside.
  std::vector<std::array<std::int32_t, 3>> triangles;
  /// [triangle] the patch that it comes from.
  std::vector<std::int32_t> patches;
  /// [grids.index(patch, i, j)] the vertex, or -1 where the patch has no sample.
  std::vector<std::int32_t> vertices;

  SurfaceView view() const { return {positions, triangles}; }
  std::int32_t vertex(std::int32_t patch, std::int32_t i, std::int32_t j) const {
    return vertices[grids.index(patch, i, j)];
  }
};

/// \pre 0 <= level < image.levels.size()
LevelMesh level_mesh(const GeometryImage& image, int level);

/// The same of patches that are not packed.
LevelMesh patch_mesh(const PatchSet& patches);

/// Vertices inside the surface with other than 6 triangles, on its boundary with other than 4; ascending. Four, because
/// the boundary is a diagonal of its patches: the triangles at both ends of a fan are halves. For the same reason the
/// vertices beside it, (i, i + 1) of half patches, are among those found.
std::vector<std::int32_t> irregular_vertices(const LevelMesh& mesh);

}  // namespace lozenge
