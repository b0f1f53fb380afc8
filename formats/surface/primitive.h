// What every reader of an input format gives: triangles of one material, with their vertices' attributes.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace lozenge {

struct Primitive {
  std::vector<float> positions;  ///< 3 for each vertex, finite
  std::vector<float> normals;    ///< 3 for each vertex, or empty
  std::vector<float> uvs;        ///< TEXCOORD_0, 2 for each vertex, or empty
  std::vector<float> colors;     ///< COLOR_0, 4 for each vertex, or empty
  std::vector<float> sheets;     ///< `kSheetAttribute`, 1 for each vertex, or empty
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::int32_t material = -1;

  std::size_t vertices() const { return positions.size() / 3; }
};

}  // namespace lozenge
