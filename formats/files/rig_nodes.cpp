// Samplers of equal times share them, as exporters' files do.
#include "formats/files/rig_nodes.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <map>
#include <vector>

#include "formats/base/utf8.h"
#include "formats/files/readers/gltf/values.h"

namespace lozenge {

namespace {

constexpr const char* kLights = "KHR_lights_punctual";

class RigWriter {
 public:
  RigWriter(const Rig& rig, tinygltf::Model& model, GltfBuffer& buffer)
      : rig_(rig), model_(model), buffer_(buffer), first_node_(static_cast<int>(model.nodes.size())) {}

  int write() {
    for (const RigNode& node : rig_.nodes) add_node(node);
    for (const RigSkin& skin : rig_.skins) add_skin(skin);
    for (const Animation& animation : rig_.animations) add_animation(animation);
    for (const RigCamera& camera : rig_.cameras) add_camera(camera);
    for (const RigLight& light : rig_.lights) add_light(light);
    add_numbers();
    return first_node_;
  }

 private:
  void add_node(const RigNode& from) {
    const auto id = static_cast<int>(model_.nodes.size());
    tinygltf::Node& node = model_.nodes.emplace_back();
    node.name = valid_utf8(from.name);
    node.matrix = from.matrix;
    node.translation = from.translation;
    node.rotation = from.rotation;
    node.scale = from.scale;
    // tinygltf writes a node without any property as null, which is none.
    const bool has_transform = !(from.matrix.empty() && from.rotation.empty() && from.scale.empty());
    if (from.name.empty() && !has_transform && from.translation.empty()) node.translation = {0, 0, 0};
    node.extras = value_of(from.extras);
    if (from.camera >= 0) node.camera = static_cast<int>(model_.cameras.size()) + from.camera;
    if (from.light >= 0) {
      const int light = static_cast<int>(model_.lights.size()) + from.light;
      node.extensions[kLights] = tinygltf::Value({{"light", tinygltf::Value(light)}});
    }
    if (from.parent >= 0) model_.nodes[first_node_ + from.parent].children.push_back(id);
    else model_.scenes.front().nodes.push_back(id);
  }

  void add_skin(const RigSkin& from) {
    std::vector<float> matrices;
    tinygltf::Skin& skin = model_.skins.emplace_back();
    skin.name = valid_utf8(from.name);
    for (const std::int32_t joint : from.joints) skin.joints.push_back(first_node_ + joint);
    if (from.skeleton >= 0) skin.skeleton = first_node_ + from.skeleton;
    for (const Placement& matrix : from.inverse_binds) matrices.insert(matrices.end(), matrix.begin(), matrix.end());
    skin.inverseBindMatrices = numbers(matrices, 16);
  }

  void add_animation(const Animation& from) {
    tinygltf::Animation& animation = model_.animations.emplace_back();
    animation.name = valid_utf8(from.name);
    for (const AnimationSampler& sampler : from.samplers) {
      tinygltf::AnimationSampler& to = animation.samplers.emplace_back();
      to.interpolation = kKeyInterpolations[static_cast<std::size_t>(sampler.interpolation)];
      to.input = numbers(sampler.times, 1);
      // Weights of morph targets are no vectors, but scalars one after the other.
      const bool are_weights = std::any_of(from.channels.begin(), from.channels.end(), [&](const auto& channel) {
        return channel.path == ChannelPath::kWeights && &from.samplers[channel.sampler] == &sampler;
      });
      to.output = numbers(sampler.values, are_weights ? 1 : sampler.components);
    }
    for (const AnimationChannel& channel : from.channels) {
      tinygltf::AnimationChannel& to = animation.channels.emplace_back();
      to.sampler = channel.sampler;
      to.target_node = first_node_ + channel.node;
      to.target_path = kChannelPaths[static_cast<std::size_t>(channel.path)];
    }
  }

  void add_camera(const RigCamera& from) {
    tinygltf::Camera& camera = model_.cameras.emplace_back();
    camera.name = valid_utf8(from.name);
    camera.type = from.is_orthographic ? "orthographic" : "perspective";
    camera.perspective.aspectRatio = camera.orthographic.xmag = from.width;
    camera.perspective.yfov = camera.orthographic.ymag = from.height;
    camera.perspective.znear = camera.orthographic.znear = from.near;
    camera.perspective.zfar = camera.orthographic.zfar = from.far;
  }

  void add_light(const RigLight& from) {
    if (model_.lights.empty()) model_.extensionsUsed.emplace_back(kLights);
    tinygltf::Light& light = model_.lights.emplace_back();
    light.name = valid_utf8(from.name);
    light.type = from.type;
    light.color = {from.colour.x, from.colour.y, from.colour.z};
    light.intensity = from.intensity;
    light.range = from.range;
    light.spot.innerConeAngle = from.inner_angle;
    light.spot.outerConeAngle = from.outer_angle;
  }

  /// The accessor of these numbers, whose bytes are still to come; times (of one component) have bounds, as the format
  /// demands.
  int numbers(const std::vector<float>& values, int components) {
    const auto [place, is_new] = known_.try_emplace({components, values}, -1);
    if (!is_new) return place->second;
    place->second = static_cast<int>(model_.accessors.size());
    tinygltf::Accessor& accessor = model_.accessors.emplace_back();
    std::vector<float>& pool = pool_of(components);
    accessor.byteOffset = pool.size() * sizeof(float);
    accessor.componentType = TINYGLTF_COMPONENT_TYPE_FLOAT;
    // tinygltf numbers vectors by their components; only scalars and matrices are different.
    accessor.type = components == 1 ? TINYGLTF_TYPE_SCALAR : components == 16 ? TINYGLTF_TYPE_MAT4 : components;
    accessor.count = values.size() / static_cast<std::size_t>(components);
    if (components == 1) {
      const auto [least, greatest] = std::minmax_element(values.begin(), values.end());
      accessor.minValues = {*least};
      accessor.maxValues = {*greatest};
    }
    pool.insert(pool.end(), values.begin(), values.end());
    return place->second;
  }

  /// Matrices may not share a view with keys.
  std::vector<float>& pool_of(int components) { return components == 16 ? matrices_ : keys_; }

  /// The bytes of all of them, in a view for each pool: there may be thousands.
  void add_numbers() {
    for (const int components : {16, 1}) {
      const std::vector<float>& pool = pool_of(components);
      if (pool.empty()) continue;
      const int view =
          buffer_.add_bytes({reinterpret_cast<const unsigned char*>(pool.data()), pool.size() * sizeof(float)});
      for (const auto& [values, accessor] : known_) {
        if (&pool_of(values.first) == &pool) model_.accessors[accessor].bufferView = view;
      }
    }
  }

  const Rig& rig_;
  tinygltf::Model& model_;
  GltfBuffer& buffer_;
  int first_node_;
  std::map<std::pair<int, std::vector<float>>, int> known_;  ///< (components, numbers): their accessor
  std::vector<float> matrices_;
  std::vector<float> keys_;
};

}  // namespace

int add_rig(const Rig& rig, tinygltf::Model& model, GltfBuffer& buffer) {
  return RigWriter(rig, model, buffer).write();
}

}  // namespace lozenge
