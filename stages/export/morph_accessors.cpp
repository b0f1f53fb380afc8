#include "stages/export/morph_accessors.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <span>
#include <vector>

#include "formats/base/utf8.h"

namespace lozenge {

namespace {

template <typename Value>
int add_view(GltfBuffer& buffer, const std::vector<Value>& values) {
  return buffer.add_bytes({reinterpret_cast<const unsigned char*>(values.data()), values.size() * sizeof(Value)});
}

std::vector<std::uint32_t> changed_vertices(const std::vector<Vec3f>& deltas) {
  std::vector<std::uint32_t> changed;
  for (std::size_t v = 0; v < deltas.size(); ++v) {
    if (deltas[v] != Vec3f(0, 0, 0)) changed.push_back(static_cast<std::uint32_t>(v));
  }
  return changed;
}

/// Fills in which elements aren't zeros, and what they are.
void store_sparse(GltfBuffer& buffer, const std::vector<Vec3f>& deltas, const std::vector<std::uint32_t>& changed,
                  tinygltf::Accessor& accessor) {
  std::vector<Vec3f> values;
  for (const std::uint32_t v : changed) values.push_back(deltas[v]);
  accessor.sparse.isSparse = true;
  accessor.sparse.count = static_cast<int>(changed.size());
  accessor.sparse.indices.byteOffset = 0;
  accessor.sparse.values.byteOffset = 0;
  if (deltas.size() <= std::numeric_limits<std::uint16_t>::max()) {
    accessor.sparse.indices.componentType = TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT;
    accessor.sparse.indices.bufferView = add_view(buffer, std::vector<std::uint16_t>(changed.begin(), changed.end()));
  } else {
    accessor.sparse.indices.componentType = TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
    accessor.sparse.indices.bufferView = add_view(buffer, changed);
  }
  accessor.sparse.values.bufferView = add_view(buffer, values);
}

void set_bounds(const std::vector<Vec3f>& deltas, tinygltf::Accessor& accessor) {
  Vec3f low = deltas.front();
  Vec3f high = deltas.front();
  for (const Vec3f& d : deltas) {
    for (int c = 0; c < 3; ++c) {
      low[c] = std::min(low[c], d[c]);
      high[c] = std::max(high[c], d[c]);
    }
  }
  accessor.minValues = {low.x, low.y, low.z};
  accessor.maxValues = {high.x, high.y, high.z};
}

int add_deltas(tinygltf::Model& model, GltfBuffer& buffer, const std::vector<Vec3f>& deltas, bool with_bounds) {
  const std::vector<std::uint32_t> changed = changed_vertices(deltas);
  const std::size_t bytes_of_index = deltas.size() <= std::numeric_limits<std::uint16_t>::max() ? 2 : 4;
  // Each further view costs some bytes of JSON, too.
  constexpr std::size_t kBytesOfViews = 200;
  const std::size_t sparse = changed.size() * (bytes_of_index + sizeof(Vec3f)) + kBytesOfViews;
  tinygltf::Accessor accessor;
  accessor.componentType = TINYGLTF_COMPONENT_TYPE_FLOAT;
  accessor.type = TINYGLTF_TYPE_VEC3;
  accessor.count = deltas.size();
  if (with_bounds) set_bounds(deltas, accessor);
  if (sparse >= deltas.size() * sizeof(Vec3f)) {
    return buffer.add_floats({&deltas.front().x, 3 * deltas.size()}, 3, with_bounds);
  }
  if (!changed.empty()) store_sparse(buffer, deltas, changed, accessor);
  model.accessors.push_back(accessor);
  return static_cast<int>(model.accessors.size()) - 1;
}

}  // namespace

void add_morph_targets(tinygltf::Model& model, GltfBuffer& buffer, const EngineMesh& mesh,
                       tinygltf::Primitive& primitive) {
  for (const MorphDeltas& deltas : mesh.targets) {
    std::map<std::string, int>& target = primitive.targets.emplace_back();
    target["POSITION"] = add_deltas(model, buffer, deltas.positions, true);
    if (!deltas.normals.empty()) target["NORMAL"] = add_deltas(model, buffer, deltas.normals, false);
    if (!deltas.tangents.empty()) target["TANGENT"] = add_deltas(model, buffer, deltas.tangents, false);
  }
}

void describe_morph_targets(const std::vector<MorphTarget>& targets, tinygltf::Mesh& mesh) {
  if (targets.empty()) return;
  tinygltf::Value::Array names;
  bool any_name = false;
  for (const MorphTarget& target : targets) {
    mesh.weights.push_back(target.weight);
    names.emplace_back(valid_utf8(target.name));
    any_name = any_name || !target.name.empty();
  }
  if (any_name) mesh.extras = tinygltf::Value({{"targetNames", tinygltf::Value(std::move(names))}});
}

}  // namespace lozenge
