#include "stages/import/find_bodies.h"

#include <cmath>
#include <map>
#include <optional>

namespace lozenge {

namespace {

using Imath::M44d;

/// From where one transform has a mesh to where another one has it; nothing where that is no transform of a node.
std::optional<Placement> from_one_to_the_other(const M44d& one, const M44d& other) {
  if (const double det = one.determinant(); det == 0 || !std::isfinite(det)) return std::nullopt;
  const Placement placement = placement_of(one.inverse() * other);
  if (!is_node_transform(placement)) return std::nullopt;
  return placement;
}

class BodyFinder {
 public:
  BodyFinder(const InputAsset& asset, const std::vector<bool>& may_be_shared, const std::vector<M44d>& standing)
      : asset_(asset), may_be_shared_(may_be_shared), standing_(standing) {
    found_.body_of.assign(asset.instances.size(), -1);
    found_.is_copy.assign(asset.instances.size(), false);
  }

  FoundBodies find() {
    for (std::size_t i = 0; i < asset_.instances.size(); ++i) {
      const InputInstance& instance = asset_.instances[i];
      if (instance.skin >= 0) add_skin(i);
      else if (instance.mover >= 0) add_mover(i);
      else if (may_be_shared_[i]) add_still(i);
    }
    return std::move(found_);
  }

 private:
  std::int32_t make(const std::string& name, const std::vector<BodyPlace>& places, std::int32_t skin = -1) {
    found_.bodies.push_back({name, places, skin});
    return static_cast<std::int32_t>(found_.bodies.size()) - 1;
  }

  void add_skin(std::size_t i) {
    const std::int32_t skin = asset_.instances[i].skin;
    if (!asset_.instances[i].targets.empty()) {
      const std::int32_t node = asset_.instances[i].mover;
      found_.body_of[i] = make(name_of_node(i), {{kUnmoved, node}}, skin);
      found_.bodies.back().targets = asset_.instances[i].targets;
      return;
    }
    const auto [body, is_new] = of_skin_.try_emplace(skin, -1);
    if (is_new) body->second = make(name_of(asset_.rig.skins[skin].name, "skin", skin), {{}}, skin);
    found_.body_of[i] = body->second;
  }

  void add_mover(std::size_t i) {
    const InputInstance& instance = asset_.instances[i];
    const BodyPlace place{placement_of(standing_[instance.mover]), instance.mover};
    const bool is_shareable = may_be_shared_[i] && !instance.is_one_of_many && instance.targets.empty();
    const auto known = moving_of_mesh_.find(instance.mesh);
    if (is_shareable && known != moving_of_mesh_.end()) {
      std::vector<BodyPlace>& places = found_.bodies[known->second].places;
      const M44d first = matrix_of(places.front().placement);
      // Without what moves them they must be copies, too.
      if (from_one_to_the_other(first, standing_[instance.mover])) {
        places.push_back(place);
        found_.is_copy[i] = true;
        return;
      }
    }
    const auto [body, is_new] = of_mover_.try_emplace(instance.mover, -1);
    if (is_new) {
      body->second = make(name_of_node(i), {place});
      found_.bodies.back().targets = instance.targets;
    }
    if (is_shareable) moving_of_mesh_.try_emplace(instance.mesh, body->second);
    found_.body_of[i] = body->second;
  }

  void add_still(std::size_t i) {
    const std::vector<InputInstance>& instances = asset_.instances;
    const std::size_t first = first_still_.emplace(instances[i].mesh, i).first->second;
    if (first == i) return;
    const auto placement = from_one_to_the_other(instances[first].transform, instances[i].transform);
    if (!placement) return;
    std::int32_t& body = found_.body_of[first];
    if (body < 0) body = make(asset_.meshes[instances[i].mesh].name, {{}});
    found_.bodies[body].places.push_back({*placement, -1});
    found_.is_copy[i] = true;
  }

  std::string name_of_node(std::size_t i) const {
    const InputInstance& instance = asset_.instances[i];
    return name_of(asset_.rig.nodes[instance.mover].name, "node", instance.node);
  }

  static std::string name_of(const std::string& name, const char* kind, int number) {
    return name.empty() ? std::string(kind) + " " + std::to_string(number) : name;
  }

  const InputAsset& asset_;
  const std::vector<bool>& may_be_shared_;
  const std::vector<M44d>& standing_;
  FoundBodies found_;
  std::map<std::int32_t, std::int32_t> of_skin_;   ///< [skin]
  std::map<std::int32_t, std::int32_t> of_mover_;  ///< [node of the rig]
  std::map<int, std::int32_t> moving_of_mesh_;     ///< [mesh] its body whose places move
  std::map<int, std::size_t> first_still_;         ///< [mesh] its first instance that stands still
};

}  // namespace

FoundBodies find_bodies(const InputAsset& asset, const std::vector<bool>& may_be_shared,
                        const std::vector<M44d>& standing) {
  return BodyFinder(asset, may_be_shared, standing).find();
}

std::vector<std::int32_t> apart(const InputAsset& asset) {
  const auto skins = static_cast<std::int32_t>(asset.rig.skins.size());
  std::vector<std::int32_t> numbers;
  for (const InputInstance& instance : asset.instances) {
    // A skin's node is one to move it only where it has morph targets.
    numbers.push_back(instance.mover >= 0 ? skins + instance.mover : instance.skin);
  }
  return numbers;
}

}  // namespace lozenge
