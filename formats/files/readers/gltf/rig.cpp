// What a rig can't do without is refused where it is broken; an animation that is broken is left out with a note.
#include "formats/files/readers/gltf/rig.h"

#include <fmt/format.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "formats/base/error.h"
#include "formats/files/readers/gltf/accessor.h"
#include "formats/files/readers/gltf/values.h"

namespace lozenge {

namespace {

/// Numbers of all animations together; hours of a crowd.
constexpr std::size_t kMostKeyNumbers = std::size_t{1} << 27;

[[noreturn]] void broken(const GltfFile& file, const std::string& problem) {
  throw Error(ExitCode::kUnusableInput, file.name + ": " + problem);
}

/// Whether the accessor is there and holds at least `least` elements of so many components.
bool holds(const GltfFile& file, int accessor, int components, std::size_t least) {
  if (accessor < 0 || accessor >= static_cast<int>(file.model->accessors.size())) return false;
  const AccessorFacts facts = accessor_facts(file, accessor);
  const bool has_bytes = file.model->accessors[accessor].bufferView >= 0;
  return facts.components == components && (facts.is_float || facts.normalized) && facts.count >= least &&
         (has_bytes || facts.count <= kMostKeyNumbers / 16);
}

/// A sound one, or nothing.
std::optional<RigCamera> camera_of(const GltfFile& file, int id) {
  if (id < 0 || id >= static_cast<int>(file.model->cameras.size())) return std::nullopt;
  const tinygltf::Camera& from = file.model->cameras[id];
  const auto& perspective = from.perspective;
  const auto& orthographic = from.orthographic;
  RigCamera camera{from.name,        from.type == "orthographic", perspective.aspectRatio,
                   perspective.yfov, perspective.znear,           perspective.zfar};
  if (camera.is_orthographic) {
    camera = {from.name, true, orthographic.xmag, orthographic.ymag, orthographic.znear, orthographic.zfar};
  }
  for (const double x : {camera.width, camera.height, camera.near, camera.far}) {
    if (!std::isfinite(x)) return std::nullopt;
  }
  return camera.height != 0 ? std::optional(camera) : std::nullopt;
}

/// The same of the light that a node of the file has.
std::optional<RigLight> light_of(const GltfFile& file, const tinygltf::Node& node) {
  const auto extension = node.extensions.find("KHR_lights_punctual");
  if (extension == node.extensions.end() || !extension->second.IsObject()) return std::nullopt;
  if (!extension->second.Has("light") || !extension->second.Get("light").IsInt()) return std::nullopt;
  const int id = extension->second.Get("light").GetNumberAsInt();
  if (id < 0 || id >= static_cast<int>(file.model->lights.size())) return std::nullopt;
  const tinygltf::Light& from = file.model->lights[id];
  if (from.type != "directional" && from.type != "point" && from.type != "spot") return std::nullopt;
  RigLight light{
      from.name, from.type, {1, 1, 1}, from.intensity, from.range, from.spot.innerConeAngle, from.spot.outerConeAngle};
  for (int c = 0; c < 3 && from.color.size() == 3; ++c) light.colour[c] = from.color[c];
  for (const double x : {light.colour.x, light.colour.y, light.colour.z, light.intensity, light.range,
                         light.inner_angle, light.outer_angle}) {
    if (!std::isfinite(x)) return std::nullopt;
  }
  return light;
}

/// Takes the camera and the light of a node along; two nodes that share one have one each.
void add_camera_and_light(const GltfFile& file, const tinygltf::Node& from, RigNode& node, Rig& rig) {
  if (auto camera = camera_of(file, from.camera)) {
    node.camera = static_cast<std::int32_t>(rig.cameras.size());
    rig.cameras.push_back(std::move(*camera));
  }
  if (auto light = light_of(file, from)) {
    node.light = static_cast<std::int32_t>(rig.lights.size());
    rig.lights.push_back(std::move(*light));
  }
}

RigNode node_of(const GltfFile& file, int id) {
  const tinygltf::Node& from = file.model->nodes[id];
  RigNode node{from.name, -1, from.matrix, {}, {}, {}, text_of(from.extras)};
  if (!node.matrix.empty()) {
    if (node.matrix[3] != 0 || node.matrix[7] != 0 || node.matrix[11] != 0 || node.matrix[15] != 1) {
      broken(file, fmt::format("node {}: its matrix is not affine", id));
    }
    return node;
  }
  node.translation = from.translation;
  node.rotation = from.rotation;
  node.scale = from.scale;
  return node;
}

RigSkin skin_of(const GltfFile& file, int id, const std::vector<std::int32_t>& number) {
  const tinygltf::Skin& from = file.model->skins[id];
  RigSkin skin{from.name, {}, {}, -1};
  for (const int joint : from.joints) skin.joints.push_back(number[joint]);
  if (from.skeleton >= 0 && from.skeleton < static_cast<int>(number.size())) skin.skeleton = number[from.skeleton];
  skin.inverse_binds.assign(skin.joints.size(), kUnmoved);
  if (from.inverseBindMatrices < 0) return skin;
  if (!holds(file, from.inverseBindMatrices, 16, skin.joints.size())) {
    broken(file, fmt::format("skin {}: its inverse bind matrices are not a matrix for each of its {} joints", id,
                             skin.joints.size()));
  }
  const std::vector<float> values = read_floats(file, from.inverseBindMatrices);
  for (std::size_t j = 0; j < skin.joints.size(); ++j) {
    Placement& matrix = skin.inverse_binds[j];
    for (std::size_t i = 0; i < 16; ++i) matrix[i] = values[16 * j + i];
    if (!std::all_of(matrix.begin(), matrix.end(), [](double x) { return std::isfinite(x); })) {
      broken(file, fmt::format("skin {}: the inverse bind matrix of joint {} is not finite", id, j));
    }
  }
  return skin;
}

template <std::size_t Count>
std::optional<std::size_t> find_name(const std::array<const char*, Count>& names, const std::string& name) {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) return std::nullopt;
  return static_cast<std::size_t>(found - names.begin());
}

/// Keys of a sampler for a property of so many components, which are elements of their own where they are `scalars`;
/// nothing where they are broken.
std::optional<AnimationSampler> sampler_of(const GltfFile& file, const tinygltf::AnimationSampler& from, int components,
                                           bool scalars = false) {
  const auto interpolation = find_name(kKeyInterpolations, from.interpolation);
  if (!interpolation || !holds(file, from.input, 1, 1)) return std::nullopt;
  AnimationSampler sampler;
  sampler.interpolation = static_cast<KeyInterpolation>(*interpolation);
  sampler.components = components;
  const std::size_t keys = accessor_facts(file, from.input).count;
  const std::size_t elements = keys * (sampler.interpolation == KeyInterpolation::kCubicSpline ? 3 : 1);
  const auto numbers = elements * static_cast<std::size_t>(components);
  if (!holds(file, from.output, scalars ? 1 : components, scalars ? numbers : elements)) return std::nullopt;
  sampler.times = read_floats(file, from.input);
  sampler.values = read_floats(file, from.output);
  sampler.values.resize(numbers);
  const auto finite = [](float x) { return std::isfinite(x); };
  if (!std::all_of(sampler.values.begin(), sampler.values.end(), finite) ||
      !std::all_of(sampler.times.begin(), sampler.times.end(), finite) ||
      !std::is_sorted(sampler.times.begin(), sampler.times.end()) || sampler.times.front() < 0) {
    return std::nullopt;
  }
  return sampler;
}

/// The same of weights: those of the kept morph targets.
std::optional<AnimationSampler> weights_sampler_of(const GltfFile& file, const tinygltf::AnimationSampler& from,
                                                   const MeshTargets& targets) {
  auto sampler = sampler_of(file, from, targets.in_file, true);
  if (!sampler) return std::nullopt;
  const auto all = static_cast<std::size_t>(targets.in_file);
  std::vector<float> kept;
  for (std::size_t first = 0; first < sampler->values.size(); first += all) {
    for (const int number : targets.numbers) kept.push_back(sampler->values[first + static_cast<std::size_t>(number)]);
  }
  sampler->components = static_cast<int>(targets.numbers.size());
  sampler->values = std::move(kept);
  return sampler;
}

/// Animations of the nodes that are kept.
class AnimationReader {
 public:
  AnimationReader(const GltfFile& file, const std::vector<std::int32_t>& number,
                  const std::vector<MeshTargets>& targets)
      : file_(file), number_(number), targets_(targets) {}

  void read(const tinygltf::Animation& from, Rig& rig) {
    Animation animation{from.name, {}, {}};
    std::vector<std::int32_t> samplers(from.samplers.size(), -1);
    for (const tinygltf::AnimationChannel& channel : from.channels) add_channel(from, channel, samplers, animation);
    if (!animation.channels.empty()) rig.animations.push_back(std::move(animation));
    else ++without_channels_;
  }

  void note(std::vector<std::string>& notes) const {
    const auto add = [&](std::int64_t count, const char* one, const char* more) {
      if (count > 0) notes.push_back(fmt::format("{} {}", count, count == 1 ? one : more));
    };
    add(broken_, "animation channel left out, whose keys are broken",
        "animation channels left out, whose keys are broken");
    add(others_, "animation channel left out that moves no node", "animation channels left out that move no node");
    add(of_other_nodes_, "animation channel left out of a node that is in no scene or doesn't move",
        "animation channels left out of nodes that are in no scene or don't move");
    add(without_channels_, "animation left out of which nothing remains",
        "animations left out of which nothing remains");
  }

 private:
  void add_channel(const tinygltf::Animation& from, const tinygltf::AnimationChannel& channel,
                   std::vector<std::int32_t>& samplers, Animation& to) {
    const auto path = find_name(kChannelPaths, channel.target_path);
    if (!path) {
      ++others_;
      return;
    }
    const bool is_node = channel.target_node >= 0 && channel.target_node < static_cast<int>(number_.size());
    if (!is_node || channel.sampler < 0 || channel.sampler >= static_cast<int>(from.samplers.size())) {
      ++broken_;
      return;
    }
    const std::int32_t node = number_[channel.target_node];
    if (node < 0) {
      ++of_other_nodes_;
      return;
    }
    const auto kind = static_cast<ChannelPath>(*path);
    if (kind == ChannelPath::kWeights) {
      add_weights(from.samplers[channel.sampler], channel.target_node, to);
      return;
    }
    std::int32_t& sampler = samplers[channel.sampler];
    const int components = components_of(kind);
    // What moves a turn and a shift alike fits one of them at most.
    if (sampler < 0) sampler = add_sampler(sampler_of(file_, from.samplers[channel.sampler], components), to);
    if (sampler < 0 || to.samplers[sampler].components != components) {
      ++broken_;
      return;
    }
    to.channels.push_back({sampler, node, kind});
  }

  /// Weights of those targets that are kept: keys of their own, for another mesh may keep others.
  void add_weights(const tinygltf::AnimationSampler& from, int node, Animation& to) {
    if (static_cast<std::size_t>(node) >= targets_.size() || targets_[node].empty()) {
      ++of_other_nodes_;
      return;
    }
    auto keys = weights_sampler_of(file_, from, targets_[node]);
    const std::int32_t sampler = add_sampler(std::move(keys), to);
    if (sampler < 0) ++broken_;
    else to.channels.push_back({sampler, number_[node], ChannelPath::kWeights});
  }

  /// \return its number, or -1 where there is none
  std::int32_t add_sampler(std::optional<AnimationSampler> keys, Animation& to) {
    if (!keys) return -1;
    numbers_ += keys->times.size() + keys->values.size();
    if (numbers_ > kMostKeyNumbers) {
      throw Error(ExitCode::kLimit, file_.name + ": its animations hold more than " + std::to_string(kMostKeyNumbers) +
                                        " numbers; leave some out");
    }
    to.samplers.push_back(std::move(*keys));
    return static_cast<std::int32_t>(to.samplers.size()) - 1;
  }

  const GltfFile& file_;
  const std::vector<std::int32_t>& number_;
  const std::vector<MeshTargets>& targets_;
  std::size_t numbers_ = 0;
  std::int64_t broken_ = 0;
  std::int64_t others_ = 0;
  std::int64_t of_other_nodes_ = 0;
  std::int64_t without_channels_ = 0;
};

}  // namespace

Rig read_rig(const GltfFile& file, const std::vector<int>& nodes, const std::vector<int>& skins,
             const std::vector<MeshTargets>& targets, std::vector<std::string>& notes) {
  const tinygltf::Model& model = *file.model;
  Rig rig;
  std::vector<std::int32_t> number(model.nodes.size(), -1);  // [node of the file] that of the rig
  std::vector<std::int32_t> parent(model.nodes.size(), -1);
  for (const int id : nodes) {
    number[id] = static_cast<std::int32_t>(rig.nodes.size());
    rig.nodes.push_back(node_of(file, id));
    rig.nodes.back().parent = parent[id];
    add_camera_and_light(file, model.nodes[id], rig.nodes.back(), rig);
    for (const int child : model.nodes[id].children) parent[child] = number[id];
  }
  for (const int skin : skins) rig.skins.push_back(skin_of(file, skin, number));
  AnimationReader reader(file, number, targets);
  for (const tinygltf::Animation& animation : model.animations) reader.read(animation, rig);
  reader.note(notes);
  if (const auto defect = find_defect(rig)) broken(file, *defect);
  return rig;
}

}  // namespace lozenge
