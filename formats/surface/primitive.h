// What every reader of an input format gives: triangles of one material, with their vertices' attributes.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "formats/surface/attribute.h"

namespace lozenge {

struct Primitive {
  std::vector<float> positions;  ///< 3 for each vertex, finite
  AttributeStreams attributes;   ///< [vertex]; as the file has them: not yet made fit
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::int32_t material = -1;

  std::size_t vertices() const { return positions.size() / 3; }
};

}  // namespace lozenge
