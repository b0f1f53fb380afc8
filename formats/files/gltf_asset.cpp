#include "formats/files/gltf_asset.h"

#include <fmt/format.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <memory>

#include "formats/base/memory_budget.h"
#include "formats/files/gltf_source_mesh.h"
#include "formats/files/readers/gltf/check.h"
#include "formats/files/readers/gltf/materials.h"
#include "formats/files/readers/gltf/morph_targets.h"
#include "formats/files/readers/gltf/moving_nodes.h"
#include "formats/files/readers/gltf/primitive.h"
#include "formats/files/readers/gltf/scene.h"
#include "formats/files/readers/input_file.h"

namespace lozenge {

namespace {

/// The primitives of triangles of one mesh. \param ignored  gets the number of the others
InputMesh mesh_of(const GltfFile& file, int mesh, std::int64_t& ignored) {
  const std::vector<tinygltf::Primitive>& primitives = file.model->meshes[mesh].primitives;
  InputMesh found;
  for (int p = 0; p < static_cast<int>(primitives.size()); ++p) {
    if (!holds_triangles(file, mesh, p)) {
      ++ignored;
      continue;
    }
    const PrimitiveSize size = primitive_size(file, mesh, p);
    found.primitives.push_back({p, size.used_vertices, size.triangles, primitives[p].material});
  }
  return found;
}

void find_meshes(const GltfFile& file, InputAsset& asset) {
  asset.meshes.resize(file.model->meshes.size());
  std::vector<std::int64_t> ignored(asset.meshes.size(), -1);
  for (const InputInstance& instance : asset.instances) {
    if (ignored[instance.mesh] < 0) {
      ignored[instance.mesh] = 0;
      asset.meshes[instance.mesh] = mesh_of(file, instance.mesh, ignored[instance.mesh]);
    }
    asset.ignored_primitives += ignored[instance.mesh];
  }
  for (std::size_t m = 0; m < asset.meshes.size(); ++m) {
    const std::string& name = file.model->meshes[m].name;
    asset.meshes[m].name = name.empty() ? "mesh " + std::to_string(m) : name;
  }
}

/// [material] whether a primitive has it.
std::vector<bool> used_materials(const InputAsset& asset) {
  std::vector<bool> used(asset.material_names.size(), false);
  for (const InputMesh& mesh : asset.meshes) {
    for (const InputPrimitive& primitive : mesh.primitives) {
      if (primitive.material >= 0) used[primitive.material] = true;
    }
  }
  return used;
}

void find_materials(const GltfFile& file, MemoryBudget& budget, InputAsset& asset) {
  for (const tinygltf::Material& material : file.model->materials) asset.material_names.push_back(material.name);
  if (has_material_looks(file)) {
    GltfMaterials materials = read_materials(file, used_materials(asset), budget, asset.deviations, asset.notes);
    asset.material_looks = std::move(materials.looks);
    asset.images = std::move(materials.images);
  }
  asset.double_sided = double_sided_materials(file, asset.material_names.size());
  asset.cap_of = find_stored_caps(file);
}

void find_bodies(const GltfFile& file, const std::vector<MeshTargets>& targets, InputAsset& asset) {
  StoredBodies stored = find_stored_bodies(file);
  asset.bodies = std::move(stored.bodies);
  asset.rig = asset.bodies.empty() ? find_rig(file, targets, asset.instances, asset.notes) : std::move(stored.rig);
}

/// Lozenge's own mesh files say where their mesh came from; of others it comes from the file itself.
void find_names(const GltfFile& file, InputAsset& asset) {
  StoredNames names{scene_name(file), file.name, file.model->asset.generator};
  const bool is_surface = find_stored_names(file, names);
  asset.is_repaired = is_surface || file.model->asset.generator.starts_with("lozenge");
  asset.scene_name = std::move(names.scene);
  asset.origin = std::move(names.origin);
  asset.generator = std::move(names.generator);
}

/// "2 cameras, 1 animation", of what there is in the file beside surfaces and what moves them; empty where there is
/// nothing.
std::string other_contents(const tinygltf::Model& model, const Rig& rig) {
  std::string text;
  const auto add = [&](std::size_t number, std::size_t taken, const std::string& noun) {
    if (number <= taken) return;
    text += (text.empty() ? "" : ", ") + count_of(static_cast<std::int64_t>(number - taken), noun);
  };
  add(model.scenes.size(), 1, "other scene");
  add(model.cameras.size(), rig.cameras.size(), "camera");
  add(model.lights.size(), rig.lights.size(), "light");
  add(rig.empty() ? model.animations.size() : 0, 0, "animation");
  return text;
}

std::string unknown_extensions(const tinygltf::Model& model) {
  std::string text;
  for (const std::string& extension : model.extensionsUsed) {
    if (!knows_gltf_extension(extension)) text += (text.empty() ? "" : ", ") + extension;
  }
  return text;
}

std::size_t count_variants(const tinygltf::Model& model) {
  const auto at = model.extensions.find("KHR_materials_variants");
  if (at == model.extensions.end() || !at->second.IsObject() || !at->second.Has("variants")) return 0;
  return at->second.Get("variants").ArrayLen();
}

void note_what_is_left_out(const GltfFile& file, const std::vector<MeshTargets>& targets, InputAsset& asset) {
  std::int64_t idle = 0;
  for (std::size_t m = 0; m < targets.size(); ++m) {
    idle += targets[m].in_file - static_cast<std::int64_t>(targets[m].numbers.size());
  }
  const auto note = [&](std::int64_t count, const std::string& noun, const std::string& fate) {
    if (count > 0) asset.notes.push_back(count_of(count, noun) + " " + fate);
  };
  if (const std::size_t variants = count_variants(*file.model); variants > 0) {
    asset.notes.push_back(count_of(static_cast<std::int64_t>(variants), "variant") +
                          " of materials left out (KHR_materials_variants); the default ones are taken");
  }
  note(idle, "morph target",
       fmt::format("left out that {}, or of a mesh of more than {}", idle == 1 ? "moves nothing" : "move nothing",
                   kMostMorphTargets));
  note(asset.ignored_primitives, "primitive", "of points or lines left out");
  if (const std::string others = other_contents(*file.model, asset.rig); !others.empty()) {
    asset.notes.push_back("left out: " + others);
  }
  if (const std::string names = unknown_extensions(*file.model); !names.empty()) {
    asset.notes.push_back("extensions that Lozenge doesn't know left out: " + names);
  }
}

/// Takes out texture coordinates that no texture lies by; the first set stays, whatever it is for.
void leave_out_unused_sets(const std::vector<Material>& looks, Primitive& primitive) {
  std::erase_if(primitive.attributes, [&](const AttributeStream& stream) {
    if (!(stream.kind == kTextureCoordinates) || stream.set == 0) return false;
    return std::none_of(looks.begin(), looks.end(), [&](const Material& material) {
      return std::any_of(material.textures.begin(), material.textures.end(),
                         [&](const TextureUse& use) { return use.exists() && use.set == stream.set; });
    });
  });
}

}  // namespace

Likeness likeness_to_gltf(const InputStart& start) {
  const std::size_t first = start.bytes.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
  const bool is_json = first != std::string::npos && start.bytes[first] == '{';
  return is_json || start.bytes.starts_with("glTF") ? Likeness::kSure : Likeness::kIfNamedSo;
}

bool is_gltf(const std::filesystem::path& path) { return likeness_to_gltf(start_of(path)) == Likeness::kSure; }

InputAsset read_gltf(const std::filesystem::path& path, const InputLimits& limits) {
  InputAsset asset;
  const auto file = std::make_shared<GltfFile>(open_gltf(path, limits, &asset.deviations));
  asset.file = file->name;
  asset.instances = scene_instances(*file);
  find_meshes(*file, asset);
  MemoryBudget budget(limits.max_memory);
  budget.take(file->memory, file->name + ": reading it");
  std::vector<MeshTargets> targets = find_targets(*file, asset.instances);
  find_materials(*file, budget, asset);
  find_bodies(*file, targets, asset);
  find_names(*file, asset);
  note_what_is_left_out(*file, targets, asset);
  asset.memory = budget.taken();
  std::vector<std::vector<int>> numbers;  // [mesh][primitive] its number in the file
  for (const InputMesh& mesh : asset.meshes) {
    std::vector<int>& of_mesh = numbers.emplace_back();
    for (const InputPrimitive& primitive : mesh.primitives) of_mesh.push_back(primitive.number);
  }
  asset.extent = [file, numbers](int mesh, int primitive, bool exactly) {
    return primitive_extent(*file, mesh, numbers[mesh][primitive], exactly);
  };
  asset.read = [file, numbers = std::move(numbers), looks = asset.material_looks, targets = std::move(targets),
                joints = limits.joints](int mesh, int primitive) {
    Primitive read = read_used_vertices(*file, mesh, numbers[mesh][primitive], joints);
    add_targets(*file, mesh, numbers[mesh][primitive], targets[mesh], read);
    leave_out_unused_sets(looks, read);
    return read;
  };
  return asset;
}

}  // namespace lozenge
