// Bytes of a glTF's buffers that an object of its JSON names, checked.
#pragma once

#include <cstdint>
#include <vector>

namespace lozenge {

class GltfObject;

/// [buffer] its bytes.
using GltfBytes = std::vector<std::vector<unsigned char>>;

struct ByteRange {
  const unsigned char* data = nullptr;
  std::uint64_t size = 0;
};

/// What `buffer`, `byteOffset` and `byteLength` of a buffer view (or an extension of one) name.
/// \throws Error(kUnusableInput) where that lies outside of the buffer, or is empty
ByteRange bytes_of_range(const GltfObject& view, const GltfBytes& buffers);

}  // namespace lozenge
