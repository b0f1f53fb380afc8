#include "formats/files/readers/gltf/moving_nodes.h"

#include <fmt/format.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "formats/base/error.h"
#include "formats/files/readers/gltf/accessor.h"
#include "formats/files/readers/gltf/rig.h"
#include "formats/files/readers/gltf/scene.h"

namespace lozenge {

namespace {

using tinygltf::Model;

/// Of what a property is at rest, that its keys may be off by what exporters round.
constexpr double kRounding = 1e-6;

/// What a property of a node is at rest.
std::vector<double> rest_value(const tinygltf::Node& node, const std::string& path) {
  if (path == "translation") return node.translation.empty() ? std::vector<double>{0, 0, 0} : node.translation;
  if (path == "rotation") return node.rotation.empty() ? std::vector<double>{0, 0, 0, 1} : node.rotation;
  return node.scale.empty() ? std::vector<double>{1, 1, 1} : node.scale;
}

bool differs(const std::vector<double>& rest, const std::vector<float>& key, double sign) {
  double largest = 0;
  double difference = 0;
  for (std::size_t c = 0; c < rest.size(); ++c) {
    largest = std::max({largest, std::abs(rest[c]), static_cast<double>(std::abs(key[c]))});
    difference = std::max(difference, std::abs(rest[c] - sign * key[c]));
  }
  return !(difference <= kRounding * largest);
}

/// Between which values the keys of a sampler lie.
struct KeyRange {
  std::vector<float> least;     ///< [component]
  std::vector<float> greatest;  ///< [component]
  bool has_tangents = false;    ///< of a spline, other than zeros
};

KeyRange range_of(const std::vector<float>& keys, std::size_t components, bool is_spline) {
  KeyRange range{std::vector(components, INFINITY), std::vector(components, -INFINITY)};
  for (std::size_t i = 0; i < keys.size(); ++i) {
    if (is_spline && i / components % 3 != 1) {
      range.has_tangents = range.has_tangents || keys[i] != 0;
      continue;
    }
    float& least = range.least[i % components];
    float& greatest = range.greatest[i % components];
    least = std::min(least, keys[i]);
    greatest = std::max(greatest, keys[i]);
  }
  return range;
}

/// Whether keys are others than what their property is at rest, each found once however many channels have them.
class KeyRanges {
 public:
  explicit KeyRanges(const GltfFile& file) : file_(file) {}

  bool leave_rest(const tinygltf::Animation& animation, const tinygltf::AnimationChannel& channel) {
    if (channel.sampler < 0 || channel.sampler >= static_cast<int>(animation.samplers.size())) return false;
    const tinygltf::AnimationSampler& sampler = animation.samplers[channel.sampler];
    const auto& accessors = file_.model->accessors;
    const auto exists = [&](int accessor) { return accessor >= 0 && accessor < static_cast<int>(accessors.size()); };
    if (!exists(sampler.input) || !exists(sampler.output)) return false;
    if (accessor_facts(file_, sampler.input).components != 1) return false;
    const std::vector<double> rest = rest_value(file_.model->nodes[channel.target_node], channel.target_path);
    if (static_cast<std::size_t>(accessor_facts(file_, sampler.output).components) != rest.size()) return false;
    if (accessors[sampler.output].bufferView < 0) return true;
    const KeyRange& range = range_at(sampler.output, rest.size(), sampler.interpolation == "CUBICSPLINE");
    const auto stays = [&](double sign) {
      return !differs(rest, range.least, sign) && !differs(rest, range.greatest, sign);
    };
    // A quaternion and its negative are one turn.
    return range.has_tangents || !(stays(1) || (rest.size() == 4 && stays(-1)));
  }

 private:
  const KeyRange& range_at(int accessor, std::size_t components, bool is_spline) {
    const auto [place, is_new] = known_.try_emplace({accessor, is_spline});
    if (is_new) place->second = range_of(read_floats(file_, accessor), components, is_spline);
    return place->second;
  }

  const GltfFile& file_;
  std::map<std::pair<int, bool>, KeyRange> known_;
};

class MovingNodes {
 public:
  MovingNodes(const GltfFile& file, const std::vector<MeshTargets>& targets, std::vector<InputInstance>& instances)
      : file_(file), model_(*file.model), targets_(targets), instances_(instances), parent_(model_.nodes.size(), -1) {
    for (std::size_t n = 0; n < model_.nodes.size(); ++n) {
      for (const int child : model_.nodes[n].children) parent_[child] = static_cast<int>(n);
    }
  }

  Rig find(std::vector<std::string>& notes) {
    find_skins(notes);
    find_movers();
    find_scene();
    std::vector<bool> needed(model_.nodes.size(), false);
    const auto need = [&](int node) {
      for (; node >= 0 && !needed[node]; node = parent_[node]) needed[node] = true;
    };
    for (const int skin : skins_) {
      for (const int joint : model_.skins[skin].joints) need(joint);
    }
    const bool any = std::any_of(instances_.begin(), instances_.end(), [&](const InputInstance& instance) {
      return instance.skin >= 0 || moves(instance.node) || has_targets(instance);
    });
    for (std::size_t n = 0; any && n < moves_.size(); ++n) {
      if (is_in_scene_[n] && moves(static_cast<int>(n))) need(static_cast<int>(n));
    }
    for (const InputInstance& instance : instances_) {
      if (has_targets(instance)) need(instance.node);
    }
    const std::vector<int> nodes = in_order(needed);
    std::vector<std::int32_t> number(model_.nodes.size(), -1);
    for (std::size_t n = 0; n < nodes.size(); ++n) number[nodes[n]] = static_cast<std::int32_t>(n);
    for (InputInstance& instance : instances_) {
      const bool is_moved = instance.skin < 0 && moves(instance.node);
      if (is_moved || has_targets(instance)) instance.mover = number[instance.node];
      if (has_targets(instance)) set_weights(instance);
    }
    if (nodes.empty()) return {};
    return read_rig(file_, nodes, skins_, targets_of_nodes(), notes);
  }

 private:
  bool has_targets(const InputInstance& instance) const { return !targets_[instance.mesh].empty(); }

  /// Those of its node, else of its mesh.
  void set_weights(InputInstance& instance) const {
    const MeshTargets& targets = targets_[instance.mesh];
    const std::vector<double>& of_node = model_.nodes[instance.node].weights;
    instance.targets = targets.targets;
    if (of_node.empty()) return;
    const std::vector<double> weights = weights_of(targets, of_node);
    for (std::size_t t = 0; t < weights.size(); ++t) {
      instance.targets[t].weight = std::isfinite(weights[t]) ? weights[t] : 0;
    }
  }

  std::vector<MeshTargets> targets_of_nodes() const {
    std::vector<MeshTargets> found(model_.nodes.size());
    for (const InputInstance& instance : instances_) found[instance.node] = targets_[instance.mesh];
    return found;
  }

  bool has_influences(int mesh) const {
    const auto& primitives = model_.meshes[mesh].primitives;
    return std::all_of(primitives.begin(), primitives.end(), [](const tinygltf::Primitive& primitive) {
      return primitive.attributes.contains("JOINTS_0") && primitive.attributes.contains("WEIGHTS_0");
    });
  }

  /// The skins that place something; numbers them.
  void find_skins(std::vector<std::string>& notes) {
    std::int64_t without = 0;
    std::vector<std::int32_t> number(model_.skins.size(), -1);
    for (InputInstance& instance : instances_) {
      const int skin = model_.nodes[instance.node].skin;
      if (skin < 0) continue;
      const std::vector<int>& joints = model_.skins[skin].joints;
      if (joints.empty() || !has_influences(instance.mesh)) {
        ++without;
        continue;
      }
      for (const int joint : joints) {
        if (joint >= 0 && joint < static_cast<int>(model_.nodes.size())) continue;
        throw Error(ExitCode::kUnusableInput,
                    fmt::format("{}: skin {}: its joint {} is no node", file_.name, skin, joint));
      }
      if (number[skin] < 0) {
        number[skin] = static_cast<std::int32_t>(skins_.size());
        skins_.push_back(skin);
      }
      instance.skin = number[skin];
    }
    if (without > 0) {
      notes.push_back(count_of(without, "mesh") + (without == 1 ? " has" : " have") +
                      " a skin, but no joints or weights, and stand where their node does");
    }
  }

  /// Nodes that move against the one above them.
  void find_movers() {
    moves_.assign(model_.nodes.size(), false);
    for (const int skin : skins_) {
      for (const int joint : model_.skins[skin].joints) moves_[joint] = true;
    }
    KeyRanges keys(file_);
    for (const tinygltf::Animation& animation : model_.animations) {
      for (const tinygltf::AnimationChannel& channel : animation.channels) {
        const bool is_transform =
            channel.target_path == "translation" || channel.target_path == "rotation" || channel.target_path == "scale";
        if (!is_transform || channel.target_node < 0 || channel.target_node >= static_cast<int>(moves_.size()))
          continue;
        if (!moves_[channel.target_node]) moves_[channel.target_node] = keys.leave_rest(animation, channel);
      }
    }
  }

  void find_scene() {
    is_in_scene_.assign(model_.nodes.size(), false);
    std::vector<int> open = scene_roots(file_);
    while (!open.empty()) {
      const int node = open.back();
      open.pop_back();
      is_in_scene_[node] = true;
      open.insert(open.end(), model_.nodes[node].children.begin(), model_.nodes[node].children.end());
    }
  }

  bool moves(int node) const {
    while (node >= 0 && !moves_[node]) node = parent_[node];
    return node >= 0;
  }

  /// Depth first, roots by their numbers, children in their order.
  std::vector<int> in_order(const std::vector<bool>& needed) const {
    std::vector<int> open;
    for (int n = static_cast<int>(needed.size()); n-- > 0;) {
      if (needed[n] && parent_[n] < 0) open.push_back(n);
    }
    std::vector<int> order;
    while (!open.empty()) {
      const int node = open.back();
      open.pop_back();
      order.push_back(node);
      const std::vector<int>& children = model_.nodes[node].children;
      for (auto child = children.rbegin(); child != children.rend(); ++child) {
        if (needed[*child]) open.push_back(*child);
      }
    }
    return order;
  }

  const GltfFile& file_;
  const Model& model_;
  const std::vector<MeshTargets>& targets_;  ///< [mesh]
  std::vector<InputInstance>& instances_;
  std::vector<int> parent_;        ///< [node]
  std::vector<bool> moves_;        ///< [node] against the one above it
  std::vector<bool> is_in_scene_;  ///< [node]
  std::vector<int> skins_;         ///< of the file, that place something
};

}  // namespace

Rig find_rig(const GltfFile& file, const std::vector<MeshTargets>& targets, std::vector<InputInstance>& instances,
             std::vector<std::string>& notes) {
  return MovingNodes(file, targets, instances).find(notes);
}

}  // namespace lozenge
