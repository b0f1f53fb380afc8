// The source's own triangles, cut where the borders of patches cross their images: a level of detail that has lost
// nothing of the source, with texture coordinates in the atlas.
//
// The map is exact and linear on each source triangle, so the cuts are straight lines on the source. A cut through an
// edge is one point for both of its triangles, the pieces of a triangle fill it without gap or overlap, and each lies
// in one patch.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "formats/base/vector.h"
#include "formats/domain/parameterization.h"
#include "formats/patches/patch_layout.h"
#include "formats/surface/source_mesh.h"

namespace lozenge {

/// A vertex of the cut surface that the source doesn't have: on the edge from `ends[0]` to `ends[1]`, the lower number
/// first, at this share of the way; or inside of a triangle (`ends` -1), where a corner of patches lies.
struct CutPoint {
  std::array<VertexId, 2> ends{-1, -1};
  double share = 0;
};

struct CutCorner {
  VertexId vertex = -1;  ///< of the source, or the number of its vertices + the index of a cut point
  Vec3d weights;         ///< of the source triangle's corners
  Vec2d place;           ///< (u, v) in the piece's patch
};

/// One triangle of the cut surface.
struct CutTriangle {
  TriangleId source = -1;
  std::int32_t patch = -1;
  std::array<CutCorner, 3> corners;  ///< counter-clockwise, as the source triangle's
};

struct CutSurface {
  std::vector<CutPoint> points;
  std::vector<CutTriangle> triangles;  ///< in the order of the source's
  std::int64_t cut = 0;                ///< source triangles that were cut
};

/// \param places  the patches of the map's domain
/// \throws Error(kUnusableInput) where the map is broken, Error(kInternal) where pieces that fit together weren't found
CutSurface cut_along_patches(const SourceMesh& mesh, const Parameterization& map,
                             const std::vector<PatchPlace>& places);

}  // namespace lozenge
