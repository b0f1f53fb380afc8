// A mesh for each level of each part, one primitive each; nodes that show them, one material, its maps.
#include "stages/export/asset_writer.h"

#include <fmt/format.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "formats/base/utf8.h"
#include "formats/base/version.h"
#include "formats/files/gltf_writer.h"
#include "formats/files/material_slots.h"
#include "stages/export/asset_nodes.h"
#include "stages/export/morph_accessors.h"
#include "stages/export/own_space.h"

namespace lozenge {
namespace {

/// A level gives way to the next one where that one's triangles cover this many pixels of a screen of 1920 x 1080.
constexpr double kPixelsOfATriangle = 8;
constexpr double kPixelsOfAScreen = 1920.0 * 1080.0;

template <typename V>
std::span<const float> floats(const std::vector<V>& values) {
  return {&values[0].x, values.size() * sizeof(V) / sizeof(float)};
}

/// As 16 bits where they fit; the largest index of a width is reserved (primitive restart).
int add_indices(tinygltf::Model& model, GltfBuffer& buffer, const EngineMesh& mesh) {
  if (mesh.positions.size() > std::numeric_limits<std::uint16_t>::max()) return buffer.add_indices(mesh.indices);
  const std::vector<std::uint16_t> narrow(mesh.indices.begin(), mesh.indices.end());
  tinygltf::Accessor accessor;
  accessor.bufferView =
      buffer.add_bytes({reinterpret_cast<const unsigned char*>(narrow.data()), narrow.size() * sizeof(std::uint16_t)});
  accessor.componentType = TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT;
  accessor.type = TINYGLTF_TYPE_SCALAR;
  accessor.count = narrow.size();
  model.bufferViews[accessor.bufferView].target = TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER;
  model.accessors.push_back(accessor);
  return static_cast<int>(model.accessors.size()) - 1;
}

/// Four numbers for each vertex, as integers of this type. \return the accessor
template <typename Integer>
int add_integers(tinygltf::Model& model, GltfBuffer& buffer, const std::vector<Integer>& values, int component_type,
                 bool normalized) {
  tinygltf::Accessor accessor;
  accessor.bufferView =
      buffer.add_bytes({reinterpret_cast<const unsigned char*>(values.data()), values.size() * sizeof(Integer)});
  accessor.componentType = component_type;
  accessor.type = TINYGLTF_TYPE_VEC4;
  accessor.count = values.size() / 4;
  accessor.normalized = normalized;
  model.bufferViews[accessor.bufferView].target = TINYGLTF_TARGET_ARRAY_BUFFER;
  model.accessors.push_back(accessor);
  return static_cast<int>(model.accessors.size()) - 1;
}

/// Joints as bytes where their numbers fit; weights of two bytes. Four of each, or eight where any vertex has more.
void add_influences(tinygltf::Model& model, GltfBuffer& buffer, const EngineMesh& mesh,
                    tinygltf::Primitive& primitive) {
  for (int set = 0; set < sets_of_joints(mesh.influences); ++set) {
    std::vector<std::uint16_t> joints;
    std::vector<std::uint16_t> weights;
    const auto first = static_cast<std::size_t>(set * kJointsOfSet);
    for (std::size_t i = first; i < mesh.influences.size(); i += kInfluences.components) {
      for (std::size_t c = i; c < i + kJointsOfSet; ++c) {
        joints.push_back(static_cast<std::uint16_t>(mesh.influences[c]));
        weights.push_back(static_cast<std::uint16_t>(std::lround(mesh.influences[c + kMostJoints] * kWholeWeight)));
      }
    }
    const bool are_bytes = std::all_of(joints.begin(), joints.end(), [](std::uint16_t joint) { return joint < 256; });
    primitive.attributes[fmt::format("JOINTS_{}", set)] =
        are_bytes ? add_integers(model, buffer, std::vector<std::uint8_t>(joints.begin(), joints.end()),
                                 TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE, false)
                  : add_integers(model, buffer, joints, TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT, false);
    primitive.attributes[fmt::format("WEIGHTS_{}", set)] =
        add_integers(model, buffer, weights, TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT, true);
  }
}

/// The materials that primitives have, by number; -1 where none has it.
struct Materials {
  int sampled = -1;
  int source = -1;
};

void add_primitive(tinygltf::Model& model, GltfBuffer& buffer, const EngineMesh& level, int material,
                   tinygltf::Mesh& mesh) {
  if (level.indices.empty()) return;
  tinygltf::Primitive& primitive = mesh.primitives.emplace_back();
  primitive.attributes["POSITION"] = buffer.add_floats(floats(level.positions), 3, true);
  primitive.attributes["NORMAL"] = buffer.add_floats(floats(level.normals), 3);
  primitive.attributes["TANGENT"] = buffer.add_floats(floats(level.tangents), 4);
  primitive.attributes["TEXCOORD_0"] = buffer.add_floats(floats(level.texcoords), 2);
  if (!level.influences.empty()) add_influences(model, buffer, level, primitive);
  add_morph_targets(model, buffer, level, primitive);
  primitive.indices = add_indices(model, buffer, level);
  primitive.material = material;
  primitive.mode = TINYGLTF_MODE_TRIANGLES;
}

void add_mesh(tinygltf::Model& model, GltfBuffer& buffer, const PartLevel& level, const Materials& materials,
              const std::string& name, const std::vector<MorphTarget>& targets) {
  tinygltf::Mesh mesh;
  mesh.name = name;
  describe_morph_targets(targets, mesh);
  add_primitive(model, buffer, level.sampled, materials.sampled, mesh);
  add_primitive(model, buffer, level.source, materials.source, mesh);
  model.meshes.push_back(mesh);
}

void add_part(tinygltf::Model& model, GltfBuffer& buffer, AssetNodeWriter& nodes, const AssetPart& part,
              const Materials& materials) {
  const auto first_mesh = static_cast<int>(model.meshes.size());
  for (std::size_t l = 0; l < part.levels.size(); ++l) {
    add_mesh(model, buffer, part.levels[l], materials, l == 0 ? part.name : fmt::format("{} LOD {}", part.name, l),
             part.body.targets);
  }
  nodes.add(part.body, first_mesh, screen_coverages(part.levels));
}

/// Adds the PNG as a texture. \return its index
int add_texture(tinygltf::Model& model, GltfBuffer& buffer, const std::vector<std::uint8_t>& png,
                const std::string& name) {
  tinygltf::Image image;
  image.name = name;
  image.mimeType = "image/png";
  image.bufferView = buffer.add_bytes(png);
  model.images.push_back(image);
  tinygltf::Texture texture;
  texture.name = name;
  texture.sampler = 0;
  texture.source = static_cast<int>(model.images.size()) - 1;
  model.textures.push_back(texture);
  return static_cast<int>(model.textures.size()) - 1;
}

void add_sampler(tinygltf::Model& model) {
  tinygltf::Sampler sampler;
  sampler.magFilter = TINYGLTF_TEXTURE_FILTER_LINEAR;
  sampler.minFilter = TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_LINEAR;
  sampler.wrapS = TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE;
  sampler.wrapT = TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE;
  model.samplers.push_back(sampler);
}

void use_extension(tinygltf::Model& model, const std::string& name) {
  std::vector<std::string>& used = model.extensionsUsed;
  if (std::find(used.begin(), used.end(), name) == used.end()) used.push_back(name);
}

void set_emission(const Vec3d& factor, double strength, tinygltf::Model& model, tinygltf::Material& material) {
  constexpr const char* kStrength = "KHR_materials_emissive_strength";
  material.emissiveFactor = {factor.x, factor.y, factor.z};
  if (strength == 1 || factor == Vec3d(0, 0, 0)) return;
  material.extensions[kStrength] =
      tinygltf::Value(tinygltf::Value::Object{{"emissiveStrength", tinygltf::Value(strength)}});
  use_extension(model, kStrength);
}

/// What the source's materials say where there are no maps.
tinygltf::Material material_of_factors(tinygltf::Model& model, const std::string& name, const AssetOrigin& origin) {
  const Material& factors = origin.appearance.factors;
  tinygltf::Material material;
  material.name = name;
  material.doubleSided = origin.double_sided;
  const Vec4d& colour = factors.base_colour;
  material.pbrMetallicRoughness.baseColorFactor = {colour.x, colour.y, colour.z, colour.w};
  material.pbrMetallicRoughness.metallicFactor = factors.metallic;
  material.pbrMetallicRoughness.roughnessFactor = factors.roughness;
  set_emission(factors.emissive, factors.emissive_strength, model, material);
  if (factors.alpha_mode == AlphaMode::kBlend) material.alphaMode = "BLEND";
  if (factors.alpha_mode == AlphaMode::kMask) {
    material.alphaMode = "MASK";
    material.alphaCutoff = factors.alpha_cutoff;
  }
  return material;
}

/// A map says all of its quantity: the factor that it is multiplied with is 1.
void leave_to_map(const MaterialMap& map, const Appearance& appearance, tinygltf::Model& model,
                  tinygltf::Material& material) {
  switch (map.kind) {
    case MapKind::kBaseColour:
      material.pbrMetallicRoughness.baseColorFactor = {1, 1, 1, 1};
      if (map.has_alpha && material.alphaMode == "OPAQUE") material.alphaMode = "BLEND";
      break;
    case MapKind::kOcclusionRoughnessMetal:
      material.pbrMetallicRoughness.metallicFactor = 1;
      material.pbrMetallicRoughness.roughnessFactor = 1;
      break;
    case MapKind::kEmissive:
      set_emission({1, 1, 1}, appearance.emissive_strength, model, material);
      break;
    default:
      break;
  }
}

/// Which materials the parts need: the source's own triangles have normals, so a map of what resampled ones lack is
/// none of theirs. Where there is no such map, both have the same.
Materials materials_needed(const std::vector<AssetPart>& parts, const std::vector<MaterialMap>& maps) {
  bool sampled = false;
  bool source = false;
  for (const AssetPart& part : parts) {
    for (const PartLevel& level : part.levels) {
      sampled = sampled || !level.sampled.indices.empty();
      source = source || !level.source.indices.empty();
    }
  }
  const bool in_frames = std::any_of(
      maps.begin(), maps.end(), [](const MaterialMap& map) { return traits_of(map.kind).frames != Frames::kNone; });
  if (!source) return {0, -1};
  if (!sampled) return {-1, 0};
  return {0, in_frames ? 1 : 0};
}

/// Whether a map is for the material of this number.
bool is_for(const MapTraits& traits, const Materials& materials, int material) {
  switch (traits.frames) {
    case Frames::kLevel:
      return material == materials.sampled;
    case Frames::kSource:
      return material == materials.source;
    default:
      return true;
  }
}

void add_materials(tinygltf::Model& model, GltfBuffer& buffer, const std::vector<MaterialMap>& maps,
                   const Materials& materials, const std::string& name, const AssetOrigin& origin) {
  const int count = std::max(materials.sampled, materials.source) + 1;
  for (int m = 0; m < count; ++m) model.materials.push_back(material_of_factors(model, name, origin));
  if (materials.sampled >= 0 && materials.source > 0) model.materials[materials.source].name = name + " source";
  for (const MaterialMap& map : maps) {
    const MapTraits& traits = traits_of(map.kind);
    int texture = -1;
    for (int m = 0; m < count; ++m) {
      if (!is_for(traits, materials, m)) continue;
      if (model.samplers.empty()) add_sampler(model);
      if (texture < 0) texture = add_texture(model, buffer, map.png, std::string(traits.file_part));
      leave_to_map(map, origin.appearance, model, model.materials[m]);
      for (const MaterialSlot slot : traits.slots) {
        if (slot != MaterialSlot::kNone) texture_in(model.materials[m], slot) = texture;
      }
    }
  }
}

void describe(tinygltf::Model& model, const AssetOrigin& origin, const std::vector<AssetPart>& parts) {
  model.asset.extras = tinygltf::Value({{"source", tinygltf::Value(valid_utf8(origin.source))},
                                        {"lozenge", tinygltf::Value(std::string(version()))},
                                        {"patches", tinygltf::Value(origin.patches)},
                                        {"samples", tinygltf::Value(origin.samples)}});
  if (origin.half_patches > 0) {
    auto& extras = model.asset.extras.Get<tinygltf::Value::Object>();
    extras["half_patches"] = tinygltf::Value(origin.half_patches);
    tinygltf::Value::Array sides;
    for (const std::int64_t count : origin.boundary_sides) sides.emplace_back(static_cast<int>(count));
    extras["boundary_sides"] = tinygltf::Value(std::move(sides));
  }
  if (origin.source_triangles > 0) {
    const auto count = static_cast<int>(origin.source_triangles);
    model.asset.extras.Get<tinygltf::Value::Object>()["source_triangles"] = tinygltf::Value(count);
  }
  if (origin.cap_triangles > 0) {
    const auto count = static_cast<int>(origin.cap_triangles);
    model.asset.extras.Get<tinygltf::Value::Object>()["cap_triangles_left_out"] = tinygltf::Value(count);
  }
  std::size_t copies = 0;
  for (const AssetPart& part : parts) copies += part.body.places.size() - 1;
  if (copies > 0 || parts.size() > 1) {
    model.asset.extras.Get<tinygltf::Value::Object>()["parts"] = tinygltf::Value(static_cast<int>(parts.size()));
    model.asset.extras.Get<tinygltf::Value::Object>()["copies"] = tinygltf::Value(static_cast<int>(copies));
  }
}

void add_scene(tinygltf::Model& model, const std::string& name) {
  model.scenes.emplace_back().name = name;
  model.defaultScene = 0;
}

}  // namespace

std::vector<double> screen_coverages(std::span<const PartLevel> levels) {
  std::vector<double> coverages;
  for (std::size_t l = 1; l < levels.size(); ++l) {
    const double in_view = static_cast<double>(levels[l].triangle_count()) / 2;  // the other half faces away
    coverages.push_back(std::min(1.0, in_view * kPixelsOfATriangle / kPixelsOfAScreen));
  }
  coverages.push_back(0);
  return coverages;
}

void write_asset(const std::filesystem::path& path, const std::vector<AssetPart>& parts,
                 const std::vector<MaterialMap>& maps, const AssetOrigin& origin, const Rig& rig) {
  tinygltf::Model model;
  GltfBuffer buffer(model);
  const std::string name = valid_utf8(origin.scene_name);
  add_scene(model, name);
  const Materials materials = materials_needed(parts, maps);
  AssetNodeWriter nodes(rig, model, buffer);
  for (const AssetPart& part : parts) add_part(model, buffer, nodes, part, materials);
  add_materials(model, buffer, maps, materials, name, origin);
  describe(model, origin, parts);
  write_glb(path, model);
}

}  // namespace lozenge
