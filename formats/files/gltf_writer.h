// GLB files, made whole and always the same bytes: a tinygltf model whose only buffer is filled one accessor at a time.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

#include "formats/files/compression.h"
#include "formats/files/readers/gltf/model.h"

namespace lozenge {

/// Appends arrays to buffer 0 of a model; each becomes a buffer view of its own, aligned to 4 bytes, with an accessor
/// over it. Elements of vertex attributes must be a multiple of 4 bytes.
class GltfBuffer {
 public:
  /// Keeps a reference to `model`, whose buffers must be empty.
  explicit GltfBuffer(tinygltf::Model& model);

  /// Floats with this many components an element, for a vertex attribute. \return the accessor
  /// \param with_bounds  stores min and max, as glTF demands of POSITION
  int add_floats(std::span<const float> values, int components, bool with_bounds = false);
  /// Indices of a primitive, as UNSIGNED_INT. \return the accessor
  int add_indices(std::span<const std::uint32_t> indices);
  /// Raw bytes, for an image. \return the buffer view
  int add_bytes(std::span<const unsigned char> bytes);

 private:
  int add_view(const void* data, std::size_t size, int target);
  tinygltf::Model& model_;
};

/// Writes `model` as GLB; `asset.version` and `asset.generator` are set by this ("lozenge VERSION").
/// \throws Error(kUsage) where the file can't be written, Error(kLimit) where it would pass the 4 GB of a GLB
void write_glb(const std::filesystem::path& path, tinygltf::Model& model, Compression compression = Compression::kNone);

}  // namespace lozenge
