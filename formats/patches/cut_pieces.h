// The pieces of one source triangle: what each patch has of it.
#pragma once

#include <vector>

#include "formats/patches/edge_cuts.h"
#include "formats/patches/image_layout.h"
#include "formats/patches/source_cut.h"

namespace lozenge {

struct CutPieces {
  std::vector<CutTriangle> triangles;
  /// Corners of patches inside of the triangle; the triangles call them -1, -2, ...
  std::int32_t inner_points = 0;
};

/// \pre the edges of the triangle are cut
CutPieces pieces_of(const SourceMesh& mesh, const EdgeCuts& cuts, const ImageLayout& layout);

}  // namespace lozenge
