// Triangles whose corners lie in the squares of patches: the source's own ones, once they are cut to fit.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "formats/base/vector.h"
#include "formats/domain/source_locator.h"

namespace lozenge {

struct ChartedCorner {
  VertexId vertex = -1;
  Vec2d place{0, 0};       ///< (u, v) in the triangle's patch; beyond its borders lies what the gutter shows there
  Vec3f carried{0, 0, 0};  ///< what else is linear over the surface there, or a direction: a normal, weights, ...
};

struct ChartedTriangle {
  std::int32_t patch = -1;
  std::int32_t group = -1;               ///< `carried` of one group means nothing to another
  Vec3f normal{0, 0, 0};                 ///< unit, of the plane that it lies in; 0 where that is none
  std::array<ChartedCorner, 3> corners;  ///< counter-clockwise
};

/// Triangles that share a vertex hang together there; each has places of its own for it.
struct ChartedSurface {
  std::vector<Vec3f> positions;  ///< [vertex]
  std::vector<ChartedTriangle> triangles;
  std::vector<float> influences = {};  ///< elements of `kInfluences`, [vertex]; empty where no body has a skin
  /// [vertex] a place of the source where it lies; empty where no body has morph targets.
  std::vector<SourcePoint> origins = {};
};

}  // namespace lozenge
