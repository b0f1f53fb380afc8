// Samplers of equal times share them, as exporters' files do.
#include "formats/files/rig_nodes.h"

#include <tiny_gltf.h>

#include <map>
#include <vector>

#include "formats/base/utf8.h"

namespace lozenge {

namespace {

class RigWriter {
 public:
  RigWriter(const Rig& rig, tinygltf::Model& model, GltfBuffer& buffer)
      : rig_(rig), model_(model), buffer_(buffer), first_node_(static_cast<int>(model.nodes.size())) {}

  int write() {
    for (const RigNode& node : rig_.nodes) add_node(node);
    for (const RigSkin& skin : rig_.skins) add_skin(skin);
    for (const Animation& animation : rig_.animations) add_animation(animation);
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
      to.output = numbers(sampler.values, sampler.components);
    }
    for (const AnimationChannel& channel : from.channels) {
      tinygltf::AnimationChannel& to = animation.channels.emplace_back();
      to.sampler = channel.sampler;
      to.target_node = first_node_ + channel.node;
      to.target_path = kChannelPaths[static_cast<std::size_t>(channel.path)];
    }
  }

  /// The accessor of these numbers; times (of one component) have bounds, as the format demands.
  int numbers(const std::vector<float>& values, int components) {
    const auto [place, is_new] = known_.try_emplace({components, values}, -1);
    if (is_new) place->second = buffer_.add_numbers(values, components, components == 1);
    return place->second;
  }

  const Rig& rig_;
  tinygltf::Model& model_;
  GltfBuffer& buffer_;
  int first_node_;
  std::map<std::pair<int, std::vector<float>>, int> known_;
};

}  // namespace

int add_rig(const Rig& rig, tinygltf::Model& model, GltfBuffer& buffer) {
  return RigWriter(rig, model, buffer).write();
}

}  // namespace lozenge
