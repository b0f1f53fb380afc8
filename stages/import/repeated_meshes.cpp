#include "stages/import/repeated_meshes.h"

#include <cmath>
#include <map>
#include <optional>

namespace lozenge {

namespace {

using Imath::M44d;

/// From where one transform has a mesh to where another one has it; nothing where that is no transform of a node.
std::optional<Placement> from_one_to_the_other(const M44d& one, const M44d& other) {
  if (const double det = one.determinant(); det == 0 || !std::isfinite(det)) return std::nullopt;
  const M44d between = one.inverse() * other;
  Placement placement{};
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 3; ++column) placement[4 * row + column] = between[row][column];
  }
  placement[15] = 1;
  if (!is_node_transform(placement)) return std::nullopt;
  return placement;
}

}  // namespace

RepeatedMeshes find_repeated_meshes(const InputAsset& asset, const std::vector<bool>& may_be_shared) {
  const std::vector<InputInstance>& instances = asset.instances;
  RepeatedMeshes found;
  found.surface_of.assign(instances.size(), -1);
  found.is_copy.assign(instances.size(), false);
  std::map<int, std::size_t> first_of;  // [mesh] its first instance that may be shared
  for (std::size_t i = 0; i < instances.size(); ++i) {
    if (!may_be_shared[i]) continue;
    const std::size_t first = first_of.emplace(instances[i].mesh, i).first->second;
    if (first == i) continue;
    const auto placement = from_one_to_the_other(instances[first].transform, instances[i].transform);
    if (!placement) continue;
    std::int32_t& repeated = found.surface_of[first];
    if (repeated < 0) {
      repeated = static_cast<std::int32_t>(found.meshes.size());
      found.meshes.push_back({asset.meshes[instances[i].mesh].name, {}});
    }
    found.meshes[repeated].copies.push_back(*placement);
    found.is_copy[i] = true;
  }
  return found;
}

}  // namespace lozenge
