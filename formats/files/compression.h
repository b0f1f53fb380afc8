// How the arrays of a glTF file are packed.
#pragma once

#include <cstdint>

namespace lozenge {

enum class Compression : std::uint8_t {
  kNone,
  kMeshopt,  ///< EXT_meshopt_compression
};

}  // namespace lozenge
