// A mesh for each level of each part, one primitive each; nodes that show them, one material, its maps.
#include "stages/export/asset_writer.h"

#include <fmt/format.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>

#include "formats/base/utf8.h"
#include "formats/base/version.h"
#include "formats/files/asset_scene.h"
#include "formats/files/gltf_writer.h"
#include "formats/files/material_slots.h"
#include "formats/files/readers/gltf/values.h"
#include "stages/export/asset_nodes.h"
#include "stages/export/morph_accessors.h"
#include "stages/export/own_space.h"
#include "stages/export/quantize.h"

namespace lozenge {
namespace {

/// A level gives way to the next one where that one lies off by this many pixels of a screen of 1920 x 1080 at most, or
/// its triangles cover so many.
constexpr double kPixelsOff = 2;
constexpr double kPixelsOfATriangle = 8;
constexpr double kPixelsOfAScreen = 1920.0 * 1080.0;
/// What a box covers of the square of its diagonal: a cube, seen from any side, half of it at most.
constexpr double kBoxInSquare = 0.5;

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

/// The kinds of materials that primitives have, by number; -1 where none has it.
struct Materials {
  std::vector<int> sampled;  ///< [level in the file]
  int source = -1;
  int count = 0;
};

/// The materials of the file: of each kind one for each class of looks that is drawn, numbered as they are asked for.
class MaterialNumbers {
 public:
  struct Needed {
    int kind;
    std::int32_t look;
  };

  int of(int kind, std::int32_t look) {
    const auto at = std::find_if(needed_.begin(), needed_.end(),
                                 [&](const Needed& known) { return known.kind == kind && known.look == look; });
    if (at != needed_.end()) return static_cast<int>(at - needed_.begin());
    needed_.push_back({kind, look});
    return static_cast<int>(needed_.size()) - 1;
  }

  /// Those that were asked for, by kind and then by class. \param meshes  whose primitives get the numbers of this
  /// order
  std::vector<Needed> sorted(std::vector<tinygltf::Mesh>& meshes) const {
    std::vector<int> order(needed_.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](int a, int b) {
      return std::pair(needed_[a].kind, needed_[a].look) < std::pair(needed_[b].kind, needed_[b].look);
    });
    std::vector<int> place(order.size());
    std::vector<Needed> sorted;
    for (const int number : order) {
      place[number] = static_cast<int>(sorted.size());
      sorted.push_back(needed_[number]);
    }
    for (tinygltf::Mesh& mesh : meshes) {
      for (tinygltf::Primitive& primitive : mesh.primitives) primitive.material = place[primitive.material];
    }
    return sorted;
  }

 private:
  std::vector<Needed> needed_;
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

/// Adds parts' meshes to a model.
class MeshWriter {
 public:
  MeshWriter(const Looks& looks, const Materials& kinds, tinygltf::Model& model, GltfBuffer& buffer)
      : looks_(looks), kinds_(kinds), model_(model), buffer_(buffer) {}

  void add(AssetNodeWriter& nodes, const AssetPart& part) {
    const auto first_mesh = static_cast<int>(model_.meshes.size());
    std::vector<std::int64_t>& vertices = vertices_.emplace_back();
    for (std::size_t l = 0; l < part.levels.size(); ++l) {
      vertices.push_back(
          add_mesh(part.levels[l], l, l == 0 ? part.name : fmt::format("{} LOD {}", part.name, l), part.body.targets));
    }
    nodes.add(part.body, first_mesh, screen_coverages(part.levels));
  }

  /// To be called once, when all parts are there.
  std::vector<MaterialNumbers::Needed> number_materials() { return numbers_.sorted(model_.meshes); }
  /// [level] of all parts: of one that has fewer levels, those of its last one.
  std::vector<std::int64_t> vertices_of_levels() const {
    std::vector<std::int64_t> sums;
    for (const auto& part : vertices_) sums.resize(std::max(sums.size(), part.size()), 0);
    for (const auto& part : vertices_) {
      for (std::size_t l = 0; l < sums.size(); ++l) sums[l] += part[std::min(l, part.size() - 1)];
    }
    return sums;
  }

 private:
  std::int64_t add_mesh(const PartLevel& level, std::size_t number, const std::string& name,
                        const std::vector<MorphTarget>& targets) {
    tinygltf::Mesh mesh;
    mesh.name = name;
    describe_morph_targets(targets, mesh);
    std::int64_t vertices = 0;
    const auto add_looks = [&](const EngineMesh& all, int kind) {
      if (all.indices.empty()) return;
      if (looks_.classes().size() == 1) {
        add_primitive(model_, buffer_, all, numbers_.of(kind, 0), mesh);
        vertices += static_cast<std::int64_t>(all.positions.size());
        return;
      }
      for (const LookedMesh& part : looks_.split(all)) {
        add_primitive(model_, buffer_, part.mesh, numbers_.of(kind, part.look), mesh);
        vertices += static_cast<std::int64_t>(part.mesh.positions.size());
      }
    };
    add_looks(level.sampled, kinds_.sampled[number]);
    add_looks(level.source, kinds_.source);
    model_.meshes.push_back(std::move(mesh));
    return vertices;
  }

  const Looks& looks_;
  const Materials& kinds_;
  tinygltf::Model& model_;
  GltfBuffer& buffer_;
  MaterialNumbers numbers_;
  std::vector<std::vector<std::int64_t>> vertices_;  ///< [part][level]
};

void use_extension(tinygltf::Model& model, const std::string& name) {
  std::vector<std::string>& used = model.extensionsUsed;
  if (std::find(used.begin(), used.end(), name) == used.end()) used.push_back(name);
}

/// WebP is the business of an extension, and there is no other picture for who doesn't know that.
void refer_to_webp(tinygltf::Model& model, tinygltf::Texture& texture) {
  constexpr const char* kWebp = "EXT_texture_webp";
  texture.extensions[kWebp] = tinygltf::Value(tinygltf::Value::Object{{"source", tinygltf::Value(texture.source)}});
  texture.source = -1;
  use_extension(model, kWebp);
  if (model.extensionsRequired.empty()) model.extensionsRequired.emplace_back(kWebp);
}

/// Adds the picture as a texture. \return its index
int add_texture(tinygltf::Model& model, GltfBuffer& buffer, const EncodedTexture& picture, const std::string& name) {
  tinygltf::Image image;
  image.name = name;
  image.mimeType = picture.mime_type;
  image.bufferView = buffer.add_bytes(picture.bytes);
  model.images.push_back(image);
  tinygltf::Texture texture;
  texture.name = name;
  texture.sampler = 0;
  texture.source = static_cast<int>(model.images.size()) - 1;
  if (picture.mime_type == "image/webp") refer_to_webp(model, texture);
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

void set_emission(const Vec3d& factor, double strength, tinygltf::Model& model, tinygltf::Material& material) {
  constexpr const char* kStrength = "KHR_materials_emissive_strength";
  material.emissiveFactor = {factor.x, factor.y, factor.z};
  if (strength == 1 || factor == Vec3d(0, 0, 0)) return;
  material.extensions[kStrength] =
      tinygltf::Value(tinygltf::Value::Object{{"emissiveStrength", tinygltf::Value(strength)}});
  use_extension(model, kStrength);
}

void set_extensions(const std::string& text, tinygltf::Model& model, tinygltf::Material& material) {
  const tinygltf::Value extensions = value_of(text);
  if (!extensions.IsObject()) return;
  for (const auto& [name, value] : extensions.Get<tinygltf::Value::Object>()) {
    material.extensions[name] = value;
    use_extension(model, name);
  }
}

/// A number of an extension, or three of them, times what all of a map holds. \pre the extension is an object
void scale_factor(const ExtensionTexture& row, const ConstantMap& constant, tinygltf::Value& extension) {
  using tinygltf::Value;
  if (row.factor.empty()) return;
  auto& numbers = extension.Get<Value::Object>();
  const std::string name(row.factor);
  const auto share = [&](std::int32_t channel) {
    return static_cast<double>(constant.value[static_cast<std::size_t>(row.first_channel + channel)]);
  };
  const Value& said = extension.Get(name);
  if (row.channels > 1) {
    Value::Array scaled;
    for (std::int32_t c = 0; c < row.channels; ++c) {
      scaled.emplace_back(share(c) * (said.IsArray() ? said.Get(c).GetNumberAsDouble() : row.usual_factor));
    }
    numbers[name] = Value(std::move(scaled));
    return;
  }
  double least = 0;
  if (row.role == TextureRole::kIridescenceThickness) {
    constexpr double kUsualLeast = 100;
    const Value& minimum = extension.Get("iridescenceThicknessMinimum");
    least = minimum.IsNumber() ? minimum.GetNumberAsDouble() : kUsualLeast;
  }
  const double most = said.IsNumber() ? said.GetNumberAsDouble() : row.usual_factor;
  numbers[name] = Value(least + (most - least) * share(0));
}

/// Extensions' maps that would be the same everywhere are factors.
void take_constants(const std::vector<ConstantMap>& constants, tinygltf::Material& material) {
  for (const ConstantMap& constant : constants) {
    for (const MaterialSlot slot : traits_of(constant.kind).slots) {
      const ExtensionTexture* row = extension_texture(slot);
      if (row == nullptr || !has_slot(material, slot)) continue;
      scale_factor(*row, constant, material.extensions.at(std::string(row->extension)));
    }
  }
}

/// What the source's materials of a class say where there are no maps.
tinygltf::Material material_of_factors(tinygltf::Model& model, const std::string& name, const AssetOrigin& origin,
                                       const LookClass& look) {
  const Material& factors = origin.appearance.factors;
  tinygltf::Material material;
  material.name = name;
  material.doubleSided = look.double_sided;
  const Vec4d& colour = factors.base_colour;
  material.pbrMetallicRoughness.baseColorFactor = {colour.x, colour.y, colour.z, colour.w};
  material.pbrMetallicRoughness.metallicFactor = factors.metallic;
  material.pbrMetallicRoughness.roughnessFactor = factors.roughness;
  set_emission(factors.emissive, factors.emissive_strength, model, material);
  if (look.alpha_mode == AlphaMode::kBlend) material.alphaMode = "BLEND";
  if (look.alpha_mode == AlphaMode::kMask) {
    material.alphaMode = "MASK";
    material.alphaCutoff = factors.alpha_cutoff;
  }
  set_extensions(look.extensions, model, material);
  take_constants(origin.constants, material);
  return material;
}

/// A map says all of its quantity: the factor that it is multiplied with is 1.
void leave_to_map(const MaterialMap& map, const Appearance& appearance, tinygltf::Model& model,
                  tinygltf::Material& material) {
  switch (map.kind) {
    case MapKind::kBaseColour:
      material.pbrMetallicRoughness.baseColorFactor = {1, 1, 1, 1};
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

/// Which materials the parts need: where levels have maps of their own, each has one; else all that is resampled has
/// the same. The source's own triangles have normals, so a map of what resampled ones lack is none of theirs. Where
/// there is no such map, both have the same.
Materials materials_needed(const std::vector<AssetPart>& parts, const std::vector<MaterialMap>& maps) {
  std::vector<bool> sampled;
  bool source = false;
  for (const AssetPart& part : parts) {
    if (sampled.size() < part.levels.size()) sampled.resize(part.levels.size());
    for (std::size_t l = 0; l < part.levels.size(); ++l) {
      if (!part.levels[l].sampled.indices.empty()) sampled[l] = true;
      source = source || !part.levels[l].source.indices.empty();
    }
  }
  const bool in_frames = std::any_of(
      maps.begin(), maps.end(), [](const MaterialMap& map) { return traits_of(map.kind).frames != Frames::kNone; });
  const bool of_levels = std::any_of(maps.begin(), maps.end(), [](const MaterialMap& map) { return map.level >= 0; });
  Materials materials;
  for (const bool is_there : sampled) {
    const bool is_new = is_there && (of_levels || materials.count == 0);
    materials.sampled.push_back(!is_there ? -1 : is_new ? materials.count : 0);
    materials.count += is_new ? 1 : 0;
  }
  if (source) {
    materials.source = materials.count > 0 && !in_frames && !of_levels ? 0 : materials.count;
    materials.count = std::max(materials.count, materials.source + 1);
  }
  return materials;
}

/// Whether a map is for the material of this number: a level's own are, in the place of those of all levels.
bool is_for(const MaterialMap& map, const std::vector<MaterialMap>& maps, const Materials& materials, int material) {
  const std::vector<int>& sampled = materials.sampled;
  const auto is_own = [&](const MaterialMap& other) {
    return other.level >= 0 && sampled[static_cast<std::size_t>(other.level)] == material;
  };
  if (map.level >= 0) return is_own(map);
  if (std::any_of(maps.begin(), maps.end(), [&](const MaterialMap& m) { return m.kind == map.kind && is_own(m); })) {
    return false;
  }
  switch (traits_of(map.kind).frames) {
    case Frames::kLevel:
      return std::find(sampled.begin(), sampled.end(), material) != sampled.end();
    case Frames::kSource:
      return material == materials.source;
    default:
      return true;
  }
}

std::string name_of_texture(const MaterialMap& map) {
  const std::string_view part = traits_of(map.kind).file_part;
  return map.level > 0 ? fmt::format("{}_lod{}", part, map.level) : std::string(part);
}

/// "Ball", "Ball LOD 2", "Ball source", "Ball mask two-sided".
std::string material_name(const std::string& name, const Materials& kinds, const MaterialNumbers::Needed& needed,
                          const LookClass& look) {
  std::string text = name;
  const auto level = std::find(kinds.sampled.begin(), kinds.sampled.end(), needed.kind);
  if (level == kinds.sampled.end()) text += kinds.count > 1 ? " source" : "";
  else if (needed.kind > 0) text += fmt::format(" LOD {}", level - kinds.sampled.begin());
  if (needed.look == 0) return text;
  if (look.alpha_mode == AlphaMode::kMask) text += " mask";
  if (look.alpha_mode == AlphaMode::kBlend) text += " blend";
  return look.double_sided ? text + " two-sided" : text;
}

/// Whether a material has a map in this slot: of an extension's, those that the source has textures for.
bool takes(const tinygltf::Material& material, MaterialSlot slot, const Appearance& appearance) {
  if (slot == MaterialSlot::kNone) return false;
  const ExtensionTexture* row = extension_texture(slot);
  if (row == nullptr) return true;
  return has_slot(material, slot) && appearance.has_extension_texture[static_cast<std::size_t>(row->role)];
}

void add_materials(tinygltf::Model& model, GltfBuffer& buffer, const std::vector<MaterialMap>& maps,
                   const Materials& kinds, const std::vector<MaterialNumbers::Needed>& needed, const std::string& name,
                   const AssetOrigin& origin, const std::vector<LookClass>& classes) {
  for (const MaterialNumbers::Needed& material : needed) {
    const LookClass& look = classes[static_cast<std::size_t>(material.look)];
    model.materials.push_back(material_of_factors(model, material_name(name, kinds, material, look), origin, look));
  }
  for (const MaterialMap& map : maps) {
    int texture = -1;
    for (std::size_t m = 0; m < needed.size(); ++m) {
      const auto& slots = traits_of(map.kind).slots;
      const auto takes_it = [&](MaterialSlot slot) { return takes(model.materials[m], slot, origin.appearance); };
      if (!is_for(map, maps, kinds, needed[m].kind) || !std::any_of(slots.begin(), slots.end(), takes_it)) continue;
      if (model.samplers.empty()) add_sampler(model);
      if (texture < 0) texture = add_texture(model, buffer, map.picture, name_of_texture(map));
      leave_to_map(map, origin.appearance, model, model.materials[m]);
      for (const MaterialSlot slot : slots) {
        if (takes_it(slot)) set_texture(model.materials[m], slot, texture);
      }
    }
  }
}

void describe(tinygltf::Model& model, const AssetOrigin& origin, const std::vector<AssetPart>& parts) {
  model.asset.extras = tinygltf::Value({{"source", tinygltf::Value(valid_utf8(origin.source))},
                                        {"lozenge", tinygltf::Value(std::string(version()))},
                                        {"patches", tinygltf::Value(origin.patches)},
                                        {"samples", tinygltf::Value(origin.samples)}});
  if (const Vec3d& t = origin.translation; t != Vec3d(0, 0, 0)) {
    model.asset.extras.Get<tinygltf::Value::Object>()["translation"] =
        tinygltf::Value(tinygltf::Value::Array{tinygltf::Value(t.x), tinygltf::Value(t.y), tinygltf::Value(t.z)});
  }
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
  if (origin.is_fitted) model.asset.extras.Get<tinygltf::Value::Object>()["fitted"] = tinygltf::Value(1);
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

/// How many pixels a part may cover that is shown by this level.
double pixels_enough_for(const PartLevel& level) {
  if (!level.deviation) {
    const double in_view = static_cast<double>(level.triangle_count()) / 2;  // the other half faces away
    return in_view * kPixelsOfATriangle;
  }
  if (!(level.deviation->largest > 0)) return kPixelsOfAScreen;
  const double diagonal = kPixelsOff * level.deviation->extent / level.deviation->largest;
  return kBoxInSquare * diagonal * diagonal;
}

/// Their meshes follow each other.
std::vector<MeshGroup> groups_of(const std::vector<AssetPart>& parts) {
  std::vector<MeshGroup> groups;
  int first = 0;
  for (const AssetPart& part : parts) {
    groups.push_back({first, static_cast<int>(part.levels.size())});
    first += groups.back().count;
  }
  return groups;
}

void add_scene(tinygltf::Model& model, const std::string& name) {
  model.scenes.emplace_back().name = name;
  model.defaultScene = 0;
}

}  // namespace

std::vector<double> screen_coverages(std::span<const PartLevel> levels) {
  std::vector<double> coverages;
  for (std::size_t l = 1; l < levels.size(); ++l) {
    const double pixels = pixels_enough_for(levels[l]);
    coverages.push_back(std::min(coverages.empty() ? 1.0 : coverages.back(), pixels / kPixelsOfAScreen));
  }
  coverages.push_back(0);
  return coverages;
}

std::vector<std::int64_t> write_asset(const std::filesystem::path& path, const std::vector<AssetPart>& parts,
                                      const std::vector<MaterialMap>& maps, const AssetOrigin& origin, const Rig& rig,
                                      const Looks& looks, const ExportOptions& options) {
  tinygltf::Model model;
  GltfBuffer buffer(model);
  const std::string name = valid_utf8(origin.scene_name);
  add_scene(model, name);
  const Materials materials = materials_needed(parts, maps);
  AssetNodeWriter nodes(rig, origin.translation, options.lods_as, model, buffer);
  MeshWriter meshes(looks, materials, model, buffer);
  for (const AssetPart& part : parts) meshes.add(nodes, part);
  add_materials(model, buffer, maps, materials, meshes.number_materials(), name, origin, looks.classes());
  describe(model, origin, parts);
  if (options.lods_as == LodsAs::kNodes) {
    model.asset.extras.Get<tinygltf::Value::Object>()[kLodsAsNodes] = tinygltf::Value(1);
  }
  if (options.vertex_format == VertexFormat::kQuantized) quantize_vertices(model, groups_of(parts));
  write_glb(path, model, options.compression);
  return meshes.vertices_of_levels();
}

}  // namespace lozenge
