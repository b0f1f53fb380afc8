#include "formats/files/readers/gltf/primitive.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

#include "formats/base/error.h"
#include "formats/files/readers/gltf/accessor.h"
#include "formats/files/readers/gltf/influences.h"
#include "formats/surface/attribute_streams.h"
#include "formats/surface/extension_textures.h"

namespace lozenge {

namespace {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

/// One primitive, and how messages call it.
struct Source {
  const GltfFile& file;
  const tinygltf::Primitive& primitive;
  std::string place;
  std::vector<std::uint32_t> used{};  ///< the vertices that are read, ascending; empty where all are

  Source(const GltfFile& f, int mesh, int index)
      : file(f), primitive(f.model->meshes[mesh].primitives[index]), place(primitive_place(mesh, index)) {}

  std::optional<int> find(const std::string& attribute) const {
    const auto at = primitive.attributes.find(attribute);
    return at == primitive.attributes.end() ? std::nullopt : std::optional<int>(at->second);
  }
  int position() const {
    const std::optional<int> accessor = find("POSITION");
    if (!accessor) broken("has no POSITION");
    return *accessor;
  }
  bool quantized() const {
    const auto& named = file.model->extensionsUsed;
    const auto& required = file.model->extensionsRequired;
    const std::string name = "KHR_mesh_quantization";
    return std::find(named.begin(), named.end(), name) != named.end() ||
           std::find(required.begin(), required.end(), name) != required.end();
  }
  [[noreturn]] void broken(const std::string& problem) const {
    throw Error(ExitCode::kUnusableInput, file.name + ": " + place + ": " + problem);
  }
};

/// Floats of an attribute with this many components, one element for each vertex.
std::vector<float> read_attribute(const Source& source, const std::string& attribute, int accessor, int components,
                                  std::uint64_t vertices, Integers integers) {
  const AccessorFacts facts = accessor_facts(source.file, accessor);
  if (facts.components != components || !may_hold(integers, facts, source.quantized())) {
    source.broken(attribute + " is of a type that glTF doesn't allow for it");
  }
  if (facts.count != vertices) {
    source.broken(attribute + " has " + std::to_string(facts.count) + " elements, but there are " +
                  std::to_string(vertices) + " vertices");
  }
  return source.used.empty() ? read_floats(source.file, accessor) : read_floats_of(source.file, accessor, source.used);
}

std::vector<float> read_positions(const Source& source) {
  const int accessor = source.position();
  const std::uint64_t count = accessor_facts(source.file, accessor).count;
  std::vector<float> positions = read_attribute(source, "POSITION", accessor, 3, count, Integers::kQuantized);
  for (std::size_t i = 0; i < positions.size(); ++i) {
    if (!std::isfinite(positions[i])) {
      const std::size_t vertex = source.used.empty() ? i / 3 : source.used[i / 3];
      source.broken("the position of vertex " + std::to_string(vertex) + " is not finite; repair the mesh");
    }
  }
  return positions;
}

/// Gives each element of `given` components its last ones, the neutral value's.
std::vector<float> complete(const std::vector<float>& values, int given, const AttributeKind& kind) {
  const auto narrow = static_cast<std::size_t>(given);
  const auto wide = static_cast<std::size_t>(kind.components);
  std::vector<float> completed(values.size() / narrow * wide, kind.neutral);
  for (std::size_t i = 0; i * narrow < values.size(); ++i) {
    std::copy_n(&values[i * narrow], narrow, &completed[i * wide]);
  }
  return completed;
}

/// Its values, or none where the primitive doesn't have it.
std::vector<float> read_stream(const Source& source, const AttributeKind& kind, int set, std::uint64_t vertices) {
  std::string name = attribute_name(kind, set);
  std::optional<int> accessor = source.find(name);
  if (!accessor && !kind.loose_semantic.empty()) {
    name = kind.loose_semantic;
    accessor = source.find(name);
  }
  if (!accessor) return {};
  const int given = accessor_facts(source.file, *accessor).components;
  const bool narrow = kind.fewest_components > 0 && given != kind.components;
  const int components = narrow ? kind.fewest_components : kind.components;
  std::vector<float> values = read_attribute(source, name, *accessor, components, vertices, kind.integers);
  return narrow ? complete(values, components, kind) : values;
}

std::vector<float> influences_of(const Source& source, std::uint64_t vertices, int joints) {
  std::vector<float> all = read_influences(source.file, source.primitive, vertices, joints);
  if (all.empty() || source.used.empty()) return all;
  return gathered(all, kInfluences.components, std::span<const std::uint32_t>(source.used));
}

/// Whether the primitive's material has directions that tangents tell the meaning of.
bool needs_tangents(const Source& source) {
  const std::vector<tinygltf::Material>& materials = source.file.model->materials;
  const int number = source.primitive.material;
  if (number < 0 || number >= static_cast<int>(materials.size())) return false;
  const tinygltf::Material& material = materials[number];
  const auto clearcoat = material.extensions.find(std::string(kClearcoatExtension));
  return material.normalTexture.index >= 0 || material.extensions.contains(std::string(kAnisotropyExtension)) ||
         (clearcoat != material.extensions.end() && clearcoat->second.Has("clearcoatNormalTexture"));
}

AttributeStreams read_streams(const Source& source, std::uint64_t vertices, int joints) {
  AttributeStreams streams;
  for (const AttributeKind& kind : kAttributeKinds) {
    if (kind == kTangents && !needs_tangents(source)) continue;
    for (int set = 0; set < kind.sets; ++set) {
      std::vector<float> values =
          kind == kInfluences ? influences_of(source, vertices, joints) : read_stream(source, kind, set, vertices);
      if (!values.empty()) streams.push_back({kind, set, std::move(values)});
    }
  }
  return streams;
}

/// Triangles of `count` corners; `corner(k)` is the vertex of the k-th (glTF 2.0 specification, Sec. 3.7.2.1).
template <typename Corner>
Triangles assemble(int mode, std::size_t count, Corner corner) {
  Triangles triangles;
  if (mode == TINYGLTF_MODE_TRIANGLES) {
    triangles.resize(count / 3);
    for (std::size_t t = 0; t < triangles.size(); ++t)
      triangles[t] = {corner(3 * t), corner(3 * t + 1), corner(3 * t + 2)};
    return triangles;
  }
  triangles.resize(count < 3 ? 0 : count - 2);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    if (mode == TINYGLTF_MODE_TRIANGLE_FAN) {
      triangles[t] = {corner(t + 1), corner(t + 2), corner(0)};
    } else {
      triangles[t] = {corner(t), corner(t + 1 + t % 2), corner(t + 2 - t % 2)};
    }
  }
  return triangles;
}

Triangles read_triangles(const Source& source, std::uint64_t vertices) {
  const int mode = source.primitive.mode;
  std::vector<std::uint32_t> indices;
  std::size_t corners = vertices;
  if (source.primitive.indices >= 0) {
    indices = read_indices(source.file, source.primitive.indices, vertices, source.place);
    corners = indices.size();
  }
  if (indices.empty()) return assemble(mode, corners, [](std::size_t k) { return static_cast<std::uint32_t>(k); });
  return assemble(mode, corners, [&](std::size_t k) { return indices[k]; });
}

}  // namespace

std::string primitive_place(int mesh, int primitive) {
  return "mesh " + std::to_string(mesh) + " primitive " + std::to_string(primitive);
}

bool holds_triangles(const GltfFile& file, int mesh, int primitive) {
  const int mode = file.model->meshes[mesh].primitives[primitive].mode;
  return mode == TINYGLTF_MODE_TRIANGLES || mode == TINYGLTF_MODE_TRIANGLE_STRIP || mode == TINYGLTF_MODE_TRIANGLE_FAN;
}

PrimitiveSize primitive_size(const GltfFile& file, int mesh, int primitive) {
  const Source source(file, mesh, primitive);
  PrimitiveSize size;
  size.vertices = accessor_facts(file, source.position()).count;
  const std::uint64_t corners =
      source.primitive.indices >= 0 ? accessor_facts(file, source.primitive.indices).count : size.vertices;
  if (!holds_triangles(file, mesh, primitive)) return size;
  size.triangles =
      source.primitive.mode == TINYGLTF_MODE_TRIANGLES ? corners / 3 : std::max<std::uint64_t>(corners, 2) - 2;
  // Morph targets are read for all vertices.
  const bool is_morphed = !source.primitive.targets.empty();
  size.used_vertices = is_morphed ? size.vertices : std::min(size.vertices, 3 * size.triangles);
  return size;
}

Primitive read_primitive(const GltfFile& file, int mesh, int primitive, int joints) {
  const Source source(file, mesh, primitive);
  Primitive result;
  result.positions = read_positions(source);
  const std::uint64_t vertices = result.vertices();
  result.attributes = read_streams(source, vertices, joints);
  result.triangles = read_triangles(source, vertices);
  result.material = source.primitive.material;
  return result;
}

Primitive read_used_vertices(const GltfFile& file, int mesh, int primitive, int joints) {
  const PrimitiveSize size = primitive_size(file, mesh, primitive);
  if (size.used_vertices >= size.vertices) return read_primitive(file, mesh, primitive, joints);
  Source source(file, mesh, primitive);
  Primitive result;
  result.triangles = read_triangles(source, size.vertices);
  for (const auto& triangle : result.triangles) source.used.insert(source.used.end(), triangle.begin(), triangle.end());
  if (source.used.empty()) return result;
  std::sort(source.used.begin(), source.used.end());
  source.used.erase(std::unique(source.used.begin(), source.used.end()), source.used.end());
  for (auto& triangle : result.triangles) {
    for (std::uint32_t& v : triangle) {
      v = static_cast<std::uint32_t>(std::lower_bound(source.used.begin(), source.used.end(), v) - source.used.begin());
    }
  }
  result.positions = read_positions(source);
  result.attributes = read_streams(source, size.vertices, joints);
  result.material = source.primitive.material;
  return result;
}

Bounds primitive_extent(const GltfFile& file, int mesh, int primitive, bool exactly) {
  const Source source(file, mesh, primitive);
  const tinygltf::Accessor& accessor = file.model->accessors[source.position()];
  const bool is_told = accessor_facts(file, source.position()).is_float && accessor.minValues.size() == 3 &&
                       accessor.maxValues.size() == 3;
  if (is_told && !exactly) {
    const auto corner = [](const std::vector<double>& values) { return Vec3f(Vec3d(values[0], values[1], values[2])); };
    return {corner(accessor.minValues), corner(accessor.maxValues)};
  }
  const Primitive read = read_used_vertices(file, mesh, primitive);
  std::vector<Vec3f> positions;
  positions.reserve(read.vertices());
  for (std::size_t i = 0; i < read.positions.size(); i += 3) {
    positions.emplace_back(read.positions[i], read.positions[i + 1], read.positions[i + 2]);
  }
  return bounds_of(positions);
}

std::vector<float> read_custom_attribute(const GltfFile& file, int mesh, int primitive, const std::string& attribute,
                                         int components) {
  const Source source(file, mesh, primitive);
  const auto accessor = source.find(attribute);
  if (!accessor) source.broken("has no " + attribute);
  const std::uint64_t vertices = accessor_facts(file, source.position()).count;
  return read_attribute(source, attribute, *accessor, components, vertices, Integers::kQuantized);
}

}  // namespace lozenge
