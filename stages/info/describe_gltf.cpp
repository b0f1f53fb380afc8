#include "stages/info/describe_gltf.h"

#include <fmt/format.h>
#include <tiny_gltf.h>

#include <algorithm>

#include "formats/base/error.h"
#include "formats/files/readers/gltf/accessor.h"
#include "formats/files/readers/gltf/model.h"
#include "formats/files/readers/gltf/morph_targets.h"
#include "formats/files/readers/gltf/moving_nodes.h"
#include "formats/files/readers/gltf/scene.h"
#include "stages/info/describe_rig.h"
#include "stages/info/facts.h"

namespace lozenge {

namespace {

struct Counts {
  std::int64_t primitives = 0;
  std::int64_t triangles = 0;
  std::int64_t vertices = 0;
};

std::int64_t elements_of(const GltfFile& file, const tinygltf::Primitive& primitive) {
  const auto positions = primitive.attributes.find("POSITION");
  const int accessor = primitive.indices >= 0                    ? primitive.indices
                       : positions == primitive.attributes.end() ? -1
                                                                 : positions->second;
  return accessor < 0 ? 0 : static_cast<std::int64_t>(accessor_facts(file, accessor).count);
}

Counts count_of(const GltfFile& file, const tinygltf::Mesh& mesh) {
  Counts counts;
  for (const tinygltf::Primitive& primitive : mesh.primitives) {
    ++counts.primitives;
    const std::int64_t elements = elements_of(file, primitive);
    const bool strip = primitive.mode == TINYGLTF_MODE_TRIANGLE_STRIP || primitive.mode == TINYGLTF_MODE_TRIANGLE_FAN;
    if (strip) counts.triangles += std::max<std::int64_t>(elements - 2, 0);
    if (primitive.mode == TINYGLTF_MODE_TRIANGLES || primitive.mode == -1) counts.triangles += elements / 3;
    const auto positions = primitive.attributes.find("POSITION");
    if (positions != primitive.attributes.end()) {
      counts.vertices += static_cast<std::int64_t>(accessor_facts(file, positions->second).count);
    }
  }
  return counts;
}

void add_what_moves(Facts& facts, const GltfFile& file, std::vector<InputInstance>& instances) {
  try {
    std::vector<std::string> notes;
    add_rig(facts, find_rig(file, find_targets(file, instances), instances, notes));
  } catch (const Error& error) {
    // A file can be told of that can't be built.
    facts.add("broken_rig", error.what(), fmt::format("broken       {}", error.what()));
    return;
  }
  std::vector<std::string> targets;
  for (const InputInstance& instance : instances) {
    for (const MorphTarget& target : instance.targets) targets.push_back(target.name);
  }
  facts.add("morph_targets", targets, targets.empty() ? "" : fmt::format("morphs       {} targets", targets.size()));
}

}  // namespace

FileInfo describe_gltf(const std::filesystem::path& path, const std::string& changed) {
  Deviations deviations;
  const GltfFile file = open_gltf(path, {}, &deviations);
  Facts facts("glTF asset");
  if (!changed.empty()) facts.add("changed", changed, fmt::format("changed      {}", changed));
  const std::string scene = scene_name(file);
  facts.add("scene", scene, fmt::format("scene        {}", scene));
  facts.add("generator", file.model->asset.generator, fmt::format("generator    {}", file.model->asset.generator));
  Counts sum;
  std::vector<InputInstance> instances = scene_instances(file);
  for (const InputInstance& instance : instances) {
    const Counts counts = count_of(file, file.model->meshes[instance.mesh]);
    sum.primitives += counts.primitives;
    sum.triangles += counts.triangles;
    sum.vertices += counts.vertices;
  }
  facts.add("nodes_with_meshes", instances.size(),
            fmt::format("placed       {} meshes, {} primitives", instances.size(), sum.primitives));
  facts.add("primitives", sum.primitives, "");
  facts.add("triangles", sum.triangles, fmt::format("triangles    {}", sum.triangles));
  facts.add("vertices", sum.vertices, fmt::format("vertices     {}, before welding", sum.vertices));
  facts.add("materials", file.model->materials.size(),
            fmt::format("materials    {}, textures {}", file.model->materials.size(), file.model->textures.size()));
  facts.add("textures", file.model->textures.size(), "");
  facts.add("images", file.model->images.size(), fmt::format("images       {}", file.model->images.size()));
  facts.add("animations", file.model->animations.size(),
            fmt::format("animations   {}, skins {}", file.model->animations.size(), file.model->skins.size()));
  facts.add("skins", file.model->skins.size(), "");
  add_what_moves(facts, file, instances);
  facts.add("extensions", file.model->extensionsUsed,
            fmt::format("extensions   {}", file.model->extensionsUsed.empty()
                                               ? "none"
                                               : fmt::format("{}", fmt::join(file.model->extensionsUsed, ", "))));
  return facts.take();
}

}  // namespace lozenge
