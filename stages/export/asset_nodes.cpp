// Alternatives are in no scene: who doesn't know MSFT_lod must not see them. Who does puts them in the place of the
// node that names them, below the same parent. Siblings are in the scene, all of them.
#include "stages/export/asset_nodes.h"

#include <fmt/format.h>
#include <tiny_gltf.h>

#include <algorithm>

#include "formats/files/rig_nodes.h"
#include "formats/surface/placement.h"

namespace lozenge {

AssetNodeWriter::AssetNodeWriter(const Rig& rig, const Vec3d& translation, LodsAs lods_as, tinygltf::Model& model,
                                 GltfBuffer& buffer)
    : has_rig_(!rig.empty()),
      translation_(translation),
      lods_as_(lods_as),
      first_skin_(static_cast<int>(model.skins.size())),
      model_(model) {
  first_rig_node_ = add_rig(rig, model, buffer);
}

void AssetNodeWriter::add(const Body& body, int first_mesh, std::span<const double> coverages) {
  const std::size_t levels = coverages.size();
  if (has_rig_ && body.skin >= 0) {
    const int first = add_levels(first_mesh, coverages);
    for (std::size_t l = 0; l < levels; ++l) model_.nodes[first + static_cast<int>(l)].skin = first_skin_ + body.skin;
    if (body.places.front().node >= 0) move_weights(first_rig_node_ + body.places.front().node, first, levels);
    add_to_scene(first, levels);
    return;
  }
  const std::vector<Placement> copies = copies_of(body);
  for (std::size_t p = 0; p < body.places.size(); ++p) {
    const int mover = has_rig_ && body.places[p].node >= 0 ? first_rig_node_ + body.places[p].node : -1;
    if (mover >= 0 && levels == 1) {
      model_.nodes[mover].mesh = first_mesh;
      continue;
    }
    const int first = add_levels(first_mesh, coverages);
    if (mover >= 0) {
      add_below(mover, first, levels);
      move_weights(mover, first, levels);
      continue;
    }
    if (p > 0) place(first, levels, placement_of(counted_from(-translation_, matrix_of(copies[p - 1]))));
    else move(first, levels);
    add_to_scene(first, levels);
  }
}

/// \return the first of them
int AssetNodeWriter::add_levels(int first_mesh, std::span<const double> coverages) {
  const auto first = static_cast<int>(model_.nodes.size());
  tinygltf::Value::Array ids;
  tinygltf::Value::Array shares;
  for (std::size_t l = 0; l < coverages.size(); ++l) {
    tinygltf::Node& node = model_.nodes.emplace_back();
    node.mesh = first_mesh + static_cast<int>(l);
    node.name = model_.meshes[node.mesh].name;
    if (are_siblings(coverages.size())) node.name = fmt::format("{}_LOD{}", model_.meshes[first_mesh].name, l);
    if (l > 0) ids.emplace_back(first + static_cast<int>(l));
    shares.emplace_back(coverages[l]);
  }
  if (coverages.size() < 2 || lods_as_ == LodsAs::kNodes) return first;
  model_.nodes[first].extensions["MSFT_lod"] = tinygltf::Value({{"ids", tinygltf::Value(std::move(ids))}});
  model_.nodes[first].extras = tinygltf::Value({{"MSFT_screencoverage", tinygltf::Value(std::move(shares))}});
  std::vector<std::string>& used = model_.extensionsUsed;
  if (std::find(used.begin(), used.end(), "MSFT_lod") == used.end()) used.emplace_back("MSFT_lod");
  return first;
}

void AssetNodeWriter::add_to_scene(int first, std::size_t levels) {
  const int shown = are_siblings(levels) ? static_cast<int>(levels) : 1;
  for (int l = 0; l < shown; ++l) model_.scenes.front().nodes.push_back(first + l);
}

void AssetNodeWriter::add_below(int mover, int first, std::size_t levels) {
  const int shown = are_siblings(levels) ? static_cast<int>(levels) : 1;
  for (int l = 0; l < shown; ++l) model_.nodes[mover].children.push_back(first + l);
}

void AssetNodeWriter::move_weights(int mover, int first, std::size_t levels) {
  for (tinygltf::Animation& animation : model_.animations) {
    std::vector<tinygltf::AnimationChannel> of_coarser;
    for (tinygltf::AnimationChannel& channel : animation.channels) {
      if (channel.target_node != mover || channel.target_path != "weights") continue;
      channel.target_node = first;
      for (std::size_t l = 1; l < levels; ++l) {
        of_coarser.push_back(channel);
        of_coarser.back().target_node = first + static_cast<int>(l);
      }
    }
    animation.channels.insert(animation.channels.end(), of_coarser.begin(), of_coarser.end());
  }
}

void AssetNodeWriter::move(int node, std::size_t levels) {
  if (translation_ == Vec3d(0, 0, 0)) return;
  for (std::size_t l = 0; l < levels; ++l) {
    model_.nodes[node + static_cast<int>(l)].translation = {translation_.x, translation_.y, translation_.z};
  }
}

void AssetNodeWriter::place(int node, std::size_t levels, const Placement& placement) {
  if (placement == kUnmoved) return;
  for (std::size_t l = 0; l < levels; ++l) {
    model_.nodes[node + static_cast<int>(l)].matrix.assign(placement.begin(), placement.end());
  }
}

}  // namespace lozenge
