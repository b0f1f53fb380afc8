// Vertices that a surface over an atlas doesn't need are left out: those between triangles of one plane, or on a
// straight edge of two. The surface stays what it was; what changes is where texture coordinates are linear.
//
// The map is linear on each source triangle, but long edges are split before they are mapped, so a map's surface has
// many triangles where the source has one. And where the border between two patches runs past a vertex so closely that
// the gutter still shows it, the border may as well run through it: then nothing is cut there.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "formats/patches/charted_surface.h"
#include "formats/patches/map_layout.h"
#include "formats/patches/patch_layout.h"

namespace lozenge {

struct FlatVertexOptions {
  /// How far any place that is left out may move in the atlas, in texels. A filter's footprint is a texel wide: half
  /// of one is where it starts to show other texels more than its own.
  double most_texels = 1;
  /// Or how far by the longest side of its triangle in the atlas, where that is more: on a wide triangle, whose corners
  /// stay where they are, nobody sees that.
  double most_of_side = 0.03;
  bool carries_directions = false;  ///< what corners carry is of unit length
  double most_carried = 0.01;       ///< how far that may be off there
};

/// What a chart is in its atlas: the square of a patch, or anything else that `ChartedTriangle::patch` numbers.
struct ChartScale {
  double texels = 1;  ///< of a unit of its places
  double gutter = 0;  ///< texels beyond its border that show what lies there
};

/// The scales of patches in their tiles.
std::vector<ChartScale> chart_scales(const MapLayout& layout, std::int32_t patches);

/// \param charts     [chart]
/// \param adjacency  of the patches, where charts are that; else empty: borders stay where they are then
/// \return how many vertices were left out; their positions stay, without a triangle
std::int64_t leave_out_flat_vertices(ChartedSurface& surface, const std::vector<ChartScale>& charts,
                                     const std::vector<std::array<PatchSide, 4>>& adjacency,
                                     const FlatVertexOptions& options);

}  // namespace lozenge
