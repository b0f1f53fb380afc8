// How good texture coordinates are: what they cut, how they stretch, whether anything lies on anything else.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "formats/base/vector.h"

namespace lozenge {

/// Triangles over an atlas; vertices on a cut are there once for each of its sides.
struct UvSurface {
  std::vector<Vec3f> positions;
  std::vector<Vec2f> uvs;  ///< 0..1
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

struct UvStatistics {
  double area = 0;         ///< of the surface
  double seam_length = 0;  ///< on the surface, where texture coordinates break between two triangles
  double l2_stretch = 1;   ///< Sander et al. 2001: 1 keeps all lengths, but for one scale
  double atlas_share = 0;  ///< of the atlas's area, that triangles cover
  std::int64_t charts = 0;
  std::int64_t folded = 0;   ///< triangles of negative area, beyond what rounding to floats explains
  std::int64_t outside = 0;  ///< vertices beyond 0..1
  /// Texels whose middle is inside of two triangles, by more than rounding explains.
  std::int64_t overlapping_texels = 0;
  /// The least distance, in texels of a square atlas, between texels that hold middles of two charts; up to 16.
  std::int32_t least_gap = 0;
};

/// \param size  texels of the atlas's side
UvStatistics uv_statistics(const UvSurface& surface, std::int32_t size);

}  // namespace lozenge
