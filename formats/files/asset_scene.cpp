// A node that names coarser ones (MSFT_lod), or that such ones follow by their names, is a part; a further node of the
// same meshes is a further place of it. All levels of a part stand in one place.
#include "formats/files/asset_scene.h"

#include <fmt/format.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <map>
#include <set>

#include "formats/base/error.h"
#include "formats/files/readers/gltf/moving_nodes.h"
#include "formats/files/readers/gltf/scene.h"

namespace lozenge {

namespace {

[[noreturn]] void refuse(const GltfFile& file, ExitCode code, const std::string& what) {
  throw Error(code, fmt::format("{}: {}", file.name, what));
}

void append_lods(const GltfFile& file, const tinygltf::Value& lod, std::vector<int>& nodes) {
  const tinygltf::Value& ids = lod.IsObject() ? lod.Get("ids") : lod;
  if (!ids.IsArray()) refuse(file, ExitCode::kUnusableInput, "its extension MSFT_lod has no array of ids");
  for (std::size_t i = 0; i < ids.ArrayLen(); ++i) {
    const tinygltf::Value& id = ids.Get(static_cast<int>(i));
    const int node = id.IsInt() ? id.GetNumberAsInt() : -1;
    if (node < 0 || node >= static_cast<int>(file.model->nodes.size()) || file.model->nodes[node].mesh < 0) {
      refuse(file, ExitCode::kUnusableInput, fmt::format("id {} of MSFT_lod is no node with a mesh", i));
    }
    nodes.push_back(node);
  }
}

bool is_level(const GltfFile& file, int node, std::size_t level) {
  return file.model->nodes[node].mesh >= 0 && file.model->nodes[node].name.ends_with(fmt::format("_LOD{}", level));
}

/// The nodes after this one, as long as their names say that they are its levels.
void append_siblings(const GltfFile& file, std::vector<int>& nodes) {
  if (!is_level(file, nodes.front(), 0)) return;
  for (int next = nodes.front() + 1; next < static_cast<int>(file.model->nodes.size()); ++next) {
    if (!is_level(file, next, nodes.size())) return;
    nodes.push_back(next);
  }
}

/// The node, then those of its coarser levels.
std::vector<int> nodes_of_levels(const GltfFile& file, int node) {
  std::vector<int> found{node};
  if (asset_number(file, kLodsAsNodes) != 0) append_siblings(file, found);
  const auto& extensions = file.model->nodes[node].extensions;
  if (const auto lod = extensions.find("MSFT_lod"); lod != extensions.end()) append_lods(file, lod->second, found);
  return found;
}

/// Whether a node is moved against the one above it as another one is.
bool stand_alike(const tinygltf::Node& a, const tinygltf::Node& b) {
  return a.matrix == b.matrix && a.translation == b.translation && a.rotation == b.rotation && a.scale == b.scale &&
         a.skin == b.skin;
}

/// All levels of a part stand in one place.
void require_one_place(const GltfFile& file, const std::vector<int>& levels) {
  const std::vector<tinygltf::Node>& nodes = file.model->nodes;
  for (const int level : levels) {
    if (stand_alike(nodes[level], nodes[levels.front()])) continue;
    refuse(file, ExitCode::kUnusableInput,
           fmt::format("node {} shows a level of node {}, but elsewhere", level, levels.front()));
  }
}

/// A further node of a part shows all of its levels.
void require_levels_of(const GltfFile& file, const std::vector<int>& levels, const AssetNodes& part) {
  const std::vector<tinygltf::Node>& nodes = file.model->nodes;
  const bool fits = std::equal(levels.begin(), levels.end(), part.levels.begin(), part.levels.end(),
                               [&](int a, int b) { return nodes[a].mesh == nodes[b].mesh; });
  if (fits && part.joints.empty() && nodes[levels.front()].skin < 0) return;
  refuse(file, ExitCode::kUnusableInput,
         fmt::format("node {} shows a part again, but not with the same levels", levels.front()));
}

Placement placement_of(const GltfFile& file, const InputInstance& instance, const std::vector<Imath::M44d>& standing) {
  const Placement placement =
      lozenge::placement_of(instance.mover >= 0 ? standing[instance.mover] : instance.transform);
  if (!is_invertible(placement)) {
    refuse(file, ExitCode::kUnusableInput,
           fmt::format("node {} shows a part, but has no transform that keeps its extent", instance.node));
  }
  return placement;
}

/// The scene shows as many parts and copies as the file says; of an asset without copies it says nothing.
void require_numbers(const GltfFile& file, const std::vector<AssetNodes>& parts) {
  if (const auto due = std::max<std::size_t>(asset_number(file, "parts"), 1); parts.size() != due) {
    refuse(file, ExitCode::kUnsupported,
           fmt::format("its scene shows {} meshes; an asset that Lozenge exported shows as many as it says, here {}",
                       parts.size(), due));
  }
  std::size_t copies = 0;
  for (const AssetNodes& part : parts) copies += part.body.places.size() - 1;
  if (const std::int32_t due = asset_number(file, "copies"); static_cast<std::int64_t>(copies) != due) {
    refuse(file, ExitCode::kUnusableInput,
           fmt::format("its scene shows {} copies of its parts, but it says that there are {}", copies, due));
  }
}

}  // namespace

AssetScene read_asset_scene(const GltfFile& file) {
  if (std::max(file.model->defaultScene, 0) >= static_cast<int>(file.model->scenes.size())) {
    refuse(file, ExitCode::kUnusableInput, "it has no scene to show");
  }
  std::vector<InputInstance> instances = scene_instances(file);
  std::vector<std::string> notes;
  AssetScene scene;
  scene.rig = find_rig(file, find_targets(file, instances, true), instances, notes);
  const Rig& rig = scene.rig;
  const std::vector<Imath::M44d> standing = standing_transforms(rig);
  std::vector<AssetNodes>& parts = scene.parts;
  std::map<int, std::size_t> part_of;  // [mesh]
  const bool are_siblings = asset_number(file, kLodsAsNodes) != 0;
  std::set<int> coarser;  // nodes of the scene that have been seen as levels of another one
  for (const InputInstance& instance : instances) {
    if (coarser.contains(instance.node)) continue;
    const auto [place, is_new] = part_of.try_emplace(instance.mesh, parts.size());
    const std::vector<int> levels = nodes_of_levels(file, instance.node);
    require_one_place(file, levels);
    if (are_siblings) coarser.insert(levels.begin() + 1, levels.end());
    if (!is_new) {
      require_levels_of(file, levels, parts[place->second]);
      parts[place->second].body.places.push_back({placement_of(file, instance, standing), instance.mover});
      continue;
    }
    const bool is_skinned = instance.skin >= 0;
    const BodyPlace where{is_skinned ? kUnmoved : placement_of(file, instance, standing), instance.mover};
    parts.push_back({levels, {file.model->nodes[instance.node].name, {where}, instance.skin, instance.targets}, {}});
    if (is_skinned) parts.back().joints = standing_joints(rig, instance.skin, standing);
  }
  require_numbers(file, parts);
  return scene;
}

std::int32_t asset_number(const GltfFile& file, const std::string& key) {
  const tinygltf::Value& extras = file.model->asset.extras;
  if (!extras.IsObject() || !extras.Has(key) || !extras.Get(key).IsInt()) return 0;
  return std::max(extras.Get(key).GetNumberAsInt(), 0);
}

std::vector<std::int32_t> asset_numbers(const GltfFile& file, const std::string& key) {
  const tinygltf::Value& extras = file.model->asset.extras;
  std::vector<std::int32_t> numbers;
  if (!extras.IsObject() || !extras.Has(key) || !extras.Get(key).IsArray()) return numbers;
  const tinygltf::Value& list = extras.Get(key);
  for (int i = 0; i < static_cast<int>(list.ArrayLen()); ++i) {
    numbers.push_back(list.Get(i).IsInt() ? std::max(list.Get(i).GetNumberAsInt(), 0) : 0);
  }
  return numbers;
}

}  // namespace lozenge
