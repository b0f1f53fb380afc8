// One level of detail of a geometry image as a watertight triangle mesh (paper, Fig. 6).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "formats/geometry_image.h"
#include "formats/vector.h"

namespace lozenge {

/// Triangles of one level, welded wherever positions have equal bits.
///
/// Quad (i, j) of a patch is split along its short diagonal, from (i + 1, j) to (i, j + 1), into (i, j), (i + 1, j),
/// (i, j + 1) and (i + 1, j + 1), (i, j + 1), (i + 1, j). Triangles come patch by patch, then row by row. Of a patch
/// without a right side only the part v >= u exists; a quad on its diagonal gives the one triangle (i, i), (i + 1, i +
/// 1), (i, i + 1).
struct LevelMesh {
  std::int32_t samples = 0;  ///< a side
  /// [vertex]; vertices are numbered in the order in which samples (patch by patch, row by row) first hold them.
  std::vector<Vec3f> positions;
  /// [triangle], counter-clockwise seen from outside.
  std::vector<std::array<std::int32_t, 3>> triangles;
  /// [triangle] the patch that it comes from.
  std::vector<std::int32_t> patches;
  /// [(patch * samples + j) * samples + i] the vertex, or -1 where the patch has no sample.
  std::vector<std::int32_t> vertices;

  std::int32_t vertex(std::int32_t patch, std::int32_t i, std::int32_t j) const {
    return vertices[(static_cast<std::size_t>(patch) * samples + j) * samples + i];
  }
};

/// \pre 0 <= level < image.levels.size()
LevelMesh level_mesh(const GeometryImage& image, int level);

/// Vertices of the mesh that the connectivity alone tells to be irregular: inside the surface those with other than 6
/// neighbours, on its boundary those with other than 4; ascending.
std::vector<std::int32_t> irregular_vertices(const LevelMesh& mesh);

}  // namespace lozenge
