#include "formats/surface/rig.h"

#include <Imath/ImathQuat.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace lozenge {

namespace {

using Imath::M44d;

/// Scaled, then rotated, then shifted.
M44d local_transform(const RigNode& node) {
  if (node.matrix.size() == 16) {
    Placement placement{};
    std::copy(node.matrix.begin(), node.matrix.end(), placement.begin());
    return matrix_of(placement);
  }
  M44d m;
  if (node.rotation.size() == 4) {
    Imath::Quatd q(node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2]);
    const double length = std::sqrt(q.r * q.r + q.v.dot(q.v));
    if (std::abs(length - 1) > 1e-12) q /= length;
    m = q.toMatrix44();
  }
  for (int row = 0; row < 3 && node.scale.size() == 3; ++row) {
    for (int column = 0; column < 3; ++column) m[row][column] *= node.scale[row];
  }
  for (int column = 0; column < 3 && node.translation.size() == 3; ++column) m[3][column] = node.translation[column];
  return m;
}

std::vector<M44d> transforms(const Rig& rig, const std::vector<M44d>& local) {
  std::vector<M44d> worlds;
  worlds.reserve(local.size());
  for (std::size_t n = 0; n < local.size(); ++n) {
    const std::int32_t parent = rig.nodes[n].parent;
    worlds.push_back(parent < 0 ? local[n] : local[n] * worlds[parent]);
  }
  return worlds;
}

/// The node's transform without what takes its extent away.
M44d extended(const RigNode& node) {
  constexpr double kLeastScale = 1e-4;  // of the largest; far below what artists mean by flat
  const M44d m = local_transform(node);
  if (is_invertible(placement_of(m))) return m;
  RigNode standing = node;
  if (!node.matrix.empty()) {
    standing.matrix.clear();
    standing.translation = {m[3][0], m[3][1], m[3][2]};
    return local_transform(standing);
  }
  double largest = 0;
  for (const double s : standing.scale) largest = std::max(largest, std::abs(s));
  for (double& s : standing.scale) {
    if (!(std::abs(s) > kLeastScale * largest)) s = largest > 0 ? largest : 1;
  }
  return local_transform(standing);
}

}  // namespace

std::vector<M44d> rest_transforms(const Rig& rig) {
  std::vector<M44d> local;
  for (const RigNode& node : rig.nodes) local.push_back(local_transform(node));
  return transforms(rig, local);
}

std::vector<M44d> standing_transforms(const Rig& rig) {
  std::vector<M44d> local;
  for (const RigNode& node : rig.nodes) local.push_back(extended(node));
  return transforms(rig, local);
}

std::vector<M44d> standing_joints(const Rig& rig, std::size_t skin, const std::vector<M44d>& standing) {
  const RigSkin& of = rig.skins[skin];
  std::vector<M44d> matrices;
  std::vector<bool> is_good;
  for (std::size_t j = 0; j < of.joints.size(); ++j) {
    matrices.push_back(matrix_of(of.inverse_binds[j]) * standing[of.joints[j]]);
    is_good.push_back(is_invertible(placement_of(matrices.back())));
  }
  const auto joint_at = [&](std::int32_t node) {
    return static_cast<std::size_t>(std::find(of.joints.begin(), of.joints.end(), node) - of.joints.begin());
  };
  const auto first_good = static_cast<std::size_t>(std::find(is_good.begin(), is_good.end(), true) - is_good.begin());
  std::vector<M44d> result = matrices;
  for (std::size_t j = 0; j < matrices.size(); ++j) {
    if (is_good[j]) continue;
    std::size_t other = matrices.size();
    for (std::int32_t n = rig.nodes[of.joints[j]].parent; n >= 0; n = rig.nodes[n].parent) {
      other = joint_at(n);
      if (other < matrices.size() && is_good[other]) break;
      other = matrices.size();
    }
    if (other == matrices.size()) other = first_good;
    result[j] = other == matrices.size() ? M44d() : matrices[other];
  }
  return result;
}

M44d blended(const std::vector<M44d>& joints, const float* influence) {
  M44d sum(0.0);
  constexpr int kMost = kInfluences.components / 2;
  double total = 0;
  for (int i = 0; i < kMost; ++i) {
    const double weight = influence[kMost + i];
    const bool is_joint = influence[i] >= 0 && influence[i] < static_cast<float>(joints.size());
    if (weight == 0 || !is_joint) continue;
    sum += joints[static_cast<std::size_t>(influence[i])] * weight;
    total += weight;
  }
  return total > 0 ? sum * (1 / total) : M44d();
}

namespace {

bool has_sound_transform(const RigNode& node) {
  const auto sound = [](const std::vector<double>& numbers, std::size_t count) {
    return (numbers.empty() || numbers.size() == count) &&
           std::all_of(numbers.begin(), numbers.end(), [](double x) { return std::isfinite(x); });
  };
  if (!sound(node.matrix, 16) || !sound(node.translation, 3) || !sound(node.rotation, 4) || !sound(node.scale, 3)) {
    return false;
  }
  double squares = node.rotation.empty() ? 1 : 0;
  for (const double x : node.rotation) squares += x * x;
  return squares > 0;
}

std::optional<std::string> find_defect(const Animation& animation, std::size_t nodes) {
  for (const AnimationSampler& sampler : animation.samplers) {
    const std::size_t of_key = sampler.interpolation == KeyInterpolation::kCubicSpline ? 3 : 1;
    if (sampler.values.size() != of_key * sampler.times.size() * static_cast<std::size_t>(sampler.components)) {
      return fmt::format("has {} values at {} times", sampler.values.size(), sampler.times.size());
    }
  }
  for (const AnimationChannel& channel : animation.channels) {
    if (channel.node < 0 || static_cast<std::size_t>(channel.node) >= nodes || channel.sampler < 0 ||
        static_cast<std::size_t>(channel.sampler) >= animation.samplers.size()) {
      return "has a channel of a node or a sampler that isn't there";
    }
    const int components = components_of(channel.path);
    if (components != 0 && animation.samplers[channel.sampler].components != components) {
      return "has a channel whose values have another number of components than what it moves";
    }
  }
  return std::nullopt;
}

}  // namespace

std::optional<std::string> find_defect(const Rig& rig) {
  const auto nodes = static_cast<std::int32_t>(rig.nodes.size());
  for (std::int32_t n = 0; n < nodes; ++n) {
    if (rig.nodes[n].parent < -1 || rig.nodes[n].parent >= n) return fmt::format("node {} comes before its parent", n);
    if (rig.nodes[n].camera < -1 || rig.nodes[n].camera >= static_cast<std::int32_t>(rig.cameras.size()) ||
        rig.nodes[n].light < -1 || rig.nodes[n].light >= static_cast<std::int32_t>(rig.lights.size())) {
      return fmt::format("node {} has a camera or a light that isn't there", n);
    }
    if (!has_sound_transform(rig.nodes[n])) return fmt::format("node {} has a transform that is none", n);
  }
  for (std::size_t s = 0; s < rig.skins.size(); ++s) {
    const RigSkin& skin = rig.skins[s];
    const auto is_node = [&](std::int32_t joint) { return joint >= 0 && joint < nodes; };
    if (skin.joints.empty() || !std::all_of(skin.joints.begin(), skin.joints.end(), is_node) ||
        skin.inverse_binds.size() != skin.joints.size() || skin.skeleton < -1 || skin.skeleton >= nodes) {
      return fmt::format("skin {} has no joints, or some that are no nodes", s);
    }
  }
  for (std::size_t a = 0; a < rig.animations.size(); ++a) {
    if (const auto defect = find_defect(rig.animations[a], rig.nodes.size())) {
      return fmt::format("animation {} {}", a, *defect);
    }
  }
  return std::nullopt;
}

}  // namespace lozenge
