#include "formats/files/readers/gltf/range.h"

#include "formats/files/readers/gltf/json.h"

namespace lozenge {

ByteRange bytes_of_range(const GltfObject& view, const GltfBytes& buffers) {
  const std::uint64_t buffer = view.required_index("buffer", buffers.size());
  const std::uint64_t offset = view.whole_or("byteOffset", 0);
  const std::uint64_t length = view.required_whole("byteLength");
  const std::uint64_t size = buffers[buffer].size();
  if (length == 0) view.broken("byteLength is 0");
  if (offset + length > size) {
    view.broken("ends " + std::to_string(offset + length - size) + " bytes past buffer " + std::to_string(buffer) +
                ", which has " + std::to_string(size));
  }
  return {buffers[buffer].data() + offset, length};
}

}  // namespace lozenge
