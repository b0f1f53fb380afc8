// All binary data is one buffer, to which each accessor appends a view of its own, aligned to four bytes.
#include "formats/files/gltf_writer.h"

#include <tiny_gltf.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <limits>
#include <sstream>

#include "formats/base/atomic_file.h"
#include "formats/base/error.h"
#include "formats/base/version.h"
#include "formats/files/meshopt_glb.h"

namespace lozenge {

namespace {

/// Left for the JSON of a GLB whose length is stored in 32 bits.
constexpr std::size_t kMostBytes = std::numeric_limits<std::uint32_t>::max() - (std::size_t{64} << 20);

void set_bounds(std::span<const float> values, int components, tinygltf::Accessor& accessor) {
  for (int c = 0; c < components; ++c) {
    float low = values[c];
    float high = values[c];
    for (std::size_t i = c; i < values.size(); i += components) {
      low = std::min(low, values[i]);
      high = std::max(high, values[i]);
    }
    accessor.minValues.push_back(low);
    accessor.maxValues.push_back(high);
  }
}

}  // namespace

GltfBuffer::GltfBuffer(tinygltf::Model& model) : model_(model) { model_.buffers.resize(1); }

int GltfBuffer::add_view(const void* data, std::size_t size, int target) {
  std::vector<unsigned char>& bytes = model_.buffers[0].data;
  const std::size_t offset = (bytes.size() + 3) / 4 * 4;
  if (size > kMostBytes || offset > kMostBytes - size) {
    throw Error(ExitCode::kLimit, "a GLB holds at most 4 GB, and this mesh needs more; split it");
  }
  bytes.resize(offset + size);
  if (size > 0) std::memcpy(bytes.data() + offset, data, size);
  tinygltf::BufferView view;
  view.buffer = 0;
  view.byteOffset = offset;
  view.byteLength = size;
  view.target = target;
  model_.bufferViews.push_back(std::move(view));
  return static_cast<int>(model_.bufferViews.size()) - 1;
}

int GltfBuffer::add_floats(std::span<const float> values, int components, bool with_bounds) {
  tinygltf::Accessor accessor;
  accessor.bufferView = add_view(values.data(), values.size_bytes(), TINYGLTF_TARGET_ARRAY_BUFFER);
  accessor.componentType = TINYGLTF_COMPONENT_TYPE_FLOAT;
  // tinygltf numbers vectors by their components; only the scalar is different.
  accessor.type = components == 1 ? TINYGLTF_TYPE_SCALAR : components;
  accessor.count = values.size() / static_cast<std::size_t>(components);
  if (with_bounds) set_bounds(values, components, accessor);
  model_.accessors.push_back(std::move(accessor));
  return static_cast<int>(model_.accessors.size()) - 1;
}

int GltfBuffer::add_indices(std::span<const std::uint32_t> indices) {
  tinygltf::Accessor accessor;
  accessor.bufferView = add_view(indices.data(), indices.size_bytes(), TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
  accessor.componentType = TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
  accessor.type = TINYGLTF_TYPE_SCALAR;
  accessor.count = indices.size();
  model_.accessors.push_back(std::move(accessor));
  return static_cast<int>(model_.accessors.size()) - 1;
}

int GltfBuffer::add_bytes(std::span<const unsigned char> bytes) { return add_view(bytes.data(), bytes.size(), 0); }

void write_glb(const std::filesystem::path& path, tinygltf::Model& model, Compression compression) {
  model.asset.version = "2.0";
  model.asset.generator = "lozenge " + std::string(version());
  AtomicFile file(path);
  std::ofstream stream(file.temporary_path(), std::ios::binary);
  tinygltf::TinyGLTF writer;
  bool written = false;
  if (compression == Compression::kMeshopt) {
    std::ostringstream whole;
    written = stream && writer.WriteGltfSceneToStream(&model, whole, false, true);
    if (written) stream << with_meshopt_compression(whole.str());
  } else {
    written = stream && writer.WriteGltfSceneToStream(&model, stream, false, true);
  }
  stream.close();
  if (!written || !stream) {
    throw Error(ExitCode::kSystem, path.string() + ": can't be written: " + std::strerror(errno));
  }
  file.commit();
}

}  // namespace lozenge
