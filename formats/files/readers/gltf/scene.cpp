#include "formats/files/readers/gltf/scene.h"

#include <Imath/ImathQuat.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>

#include "formats/base/error.h"
#include "formats/files/readers/gltf/accessor.h"

namespace lozenge {

namespace {

using Imath::M44d;
using tinygltf::Model;
using tinygltf::Node;

[[noreturn]] void broken(const GltfFile& file, int node, const std::string& problem) {
  throw Error(ExitCode::kUnusableInput, file.name + ": node " + std::to_string(node) + ": " + problem);
}

bool is_finite(const M44d& m) {
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) {
      if (!std::isfinite(m[row][column])) return false;
    }
  }
  return true;
}

/// glTF stores matrices by columns for column vectors, which are the rows of Imath's matrices for row vectors.
M44d matrix_of(const GltfFile& file, int id, const std::vector<double>& m) {
  if (m[3] != 0 || m[7] != 0 || m[11] != 0 || m[15] != 1) broken(file, id, "its matrix is not affine");
  return {m[0], m[1], m[2], m[3], m[4], m[5], m[6], m[7], m[8], m[9], m[10], m[11], m[12], m[13], m[14], m[15]};
}

/// Scaled, then rotated, then shifted.
M44d composed_trs(const GltfFile& file, int id, const Node& node) {
  M44d m;
  if (node.rotation.size() == 4) {
    Imath::Quatd q(node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2]);
    const double length = std::sqrt(q.r * q.r + q.v.dot(q.v));
    if (!(length > 0) || !std::isfinite(length)) broken(file, id, "its rotation is not a quaternion of unit length");
    if (std::abs(length - 1) > 1e-12) q /= length;
    m = q.toMatrix44();
  }
  if (node.scale.size() == 3) {
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 3; ++column) m[row][column] *= node.scale[row];
    }
  }
  if (node.translation.size() == 3) {
    for (int column = 0; column < 3; ++column) m[3][column] = node.translation[column];
  }
  return m;
}

M44d local_transform(const GltfFile& file, int id) {
  const Node& node = file.model->nodes[id];
  return node.matrix.size() == 16 ? matrix_of(file, id, node.matrix) : composed_trs(file, id, node);
}

/// More meshes in a scene than this are no asset any more.
constexpr std::size_t kMostInstances = 1'000'000;

/// What EXT_mesh_gpu_instancing says of one property of all instances of a node, a few numbers for each.
struct InstanceProperty {
  std::vector<double> values;
  std::size_t components;

  std::vector<double> of(std::size_t instance) const {
    if (values.empty()) return {};
    const auto at = values.begin() + static_cast<std::ptrdiff_t>(instance * components);
    return {at, at + static_cast<std::ptrdiff_t>(components)};
  }
};

InstanceProperty instance_property(const GltfFile& file, int node, const tinygltf::Value& attributes, const char* name,
                                   int components) {
  InstanceProperty property{{}, static_cast<std::size_t>(components)};
  if (!attributes.Has(name)) return property;
  const int accessor = attributes.Get(name).GetNumberAsInt();
  const AccessorFacts facts = accessor_facts(file, accessor);
  if (facts.components != components || (!facts.is_float && !facts.normalized)) {
    broken(file, node, std::string("the ") + name + " of its instances is of a type that glTF doesn't allow for it");
  }
  if (facts.count > kMostInstances) {
    throw Error(ExitCode::kLimit, file.name + ": node " + std::to_string(node) + ": has " +
                                      std::to_string(facts.count) + " instances; at most " +
                                      std::to_string(kMostInstances) + " are placed");
  }
  const std::vector<float> values = read_floats(file, accessor);
  property.values.assign(values.begin(), values.end());
  return property;
}

/// From the node's mesh to the node, for each instance that EXT_mesh_gpu_instancing makes of it; nothing where the node
/// hasn't got that. Each is moved as a node is.
std::optional<std::vector<M44d>> gpu_instances(const GltfFile& file, int id) {
  const auto& extensions = file.model->nodes[id].extensions;
  const auto at = extensions.find("EXT_mesh_gpu_instancing");
  if (at == extensions.end()) return std::nullopt;
  const tinygltf::Value& attributes = at->second.Get("attributes");
  const InstanceProperty translation = instance_property(file, id, attributes, "TRANSLATION", 3);
  const InstanceProperty rotation = instance_property(file, id, attributes, "ROTATION", 4);
  const InstanceProperty scale = instance_property(file, id, attributes, "SCALE", 3);
  std::size_t count = 0;
  for (const InstanceProperty* property : {&translation, &rotation, &scale}) {
    const std::size_t found = property->values.size() / property->components;
    if (found == 0) continue;
    if (count != 0 && found != count) broken(file, id, "the attributes of its instances differ in their number");
    count = found;
  }
  std::vector<M44d> transforms;
  transforms.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    Node placed;
    placed.translation = translation.of(i);
    placed.rotation = rotation.of(i);
    placed.scale = scale.of(i);
    transforms.push_back(composed_trs(file, id, placed));
  }
  return transforms;
}

/// Adds what a node places: its mesh once, or once for each instance.
void add_instances(const GltfFile& file, int id, const M44d& transform, std::vector<InputInstance>& instances) {
  const Node& node = file.model->nodes[id];
  const auto many = gpu_instances(file, id);
  for (const M44d& local : many.value_or(std::vector<M44d>{M44d()})) {
    const M44d placed = local * transform;
    if (!is_finite(placed)) broken(file, id, "the transform of an instance is not finite");
    instances.push_back({id, node.mesh, placed, many.has_value()});
  }
  if (instances.size() > kMostInstances) {
    throw Error(ExitCode::kLimit, file.name + ": places more than " + std::to_string(kMostInstances) + " meshes");
  }
}

const tinygltf::Scene* scene_of(const Model& model) {
  if (model.scenes.empty()) return nullptr;
  return &model.scenes[static_cast<std::size_t>(std::max(model.defaultScene, 0))];
}

std::vector<int> roots_of(const Model& model) {
  if (const tinygltf::Scene* scene = scene_of(model)) return scene->nodes;
  std::vector<bool> is_child(model.nodes.size(), false);
  for (const Node& node : model.nodes) {
    for (const int child : node.children) is_child[child] = true;
  }
  std::vector<int> roots;
  for (std::size_t n = 0; n < is_child.size(); ++n) {
    if (!is_child[n]) roots.push_back(static_cast<int>(n));
  }
  return roots;
}

}  // namespace

std::vector<int> scene_roots(const GltfFile& file) { return roots_of(*file.model); }

std::vector<InputInstance> scene_instances(const GltfFile& file) {
  struct Visit {
    int node;
    M44d parent;
  };
  const Model& model = *file.model;
  std::vector<Visit> open;
  const std::vector<int> roots = roots_of(model);
  for (auto root = roots.rbegin(); root != roots.rend(); ++root) open.push_back({*root, M44d()});
  std::vector<bool> reached(model.nodes.size(), false);
  std::vector<InputInstance> instances;
  while (!open.empty()) {
    const Visit visit = open.back();
    open.pop_back();
    if (reached[visit.node]) broken(file, visit.node, "is in the scene twice");
    reached[visit.node] = true;
    const Node& node = model.nodes[visit.node];
    const M44d transform = local_transform(file, visit.node) * visit.parent;
    if (!is_finite(transform)) broken(file, visit.node, "its transform is not finite");
    if (node.mesh >= 0) add_instances(file, visit.node, transform, instances);
    for (auto child = node.children.rbegin(); child != node.children.rend(); ++child)
      open.push_back({*child, transform});
  }
  return instances;
}

std::string scene_name(const GltfFile& file) {
  const Model& model = *file.model;
  const tinygltf::Scene* scene = scene_of(model);
  if (scene != nullptr && !scene->name.empty()) return scene->name;
  if (model.meshes.size() == 1 && !model.meshes[0].name.empty()) return model.meshes[0].name;
  if (model.nodes.size() == 1 && !model.nodes[0].name.empty()) return model.nodes[0].name;
  return std::filesystem::path(file.name).stem().string();
}

}  // namespace lozenge
