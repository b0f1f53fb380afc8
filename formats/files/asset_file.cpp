// The file is read as any glTF is (readers/gltf), then as an asset of ours: nodes become levels of detail, meshes of
// one level are joined, textures are decoded. Indices are checked where they are first used.
#include "formats/files/asset_file.h"

#include <fmt/format.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "formats/base/error.h"
#include "formats/files/asset_scene.h"
#include "formats/files/material_slots.h"
#include "formats/files/openimageio.h"
#include "formats/files/picture_header.h"
#include "formats/files/readers/gltf/accessor.h"
#include "formats/files/readers/gltf/influences.h"
#include "formats/files/readers/gltf/model.h"
#include "formats/surface/placement.h"

namespace lozenge {

namespace {

/// Larger textures than any engine takes are refused before their memory is asked for.
constexpr int kLargestTexture = 32768;

/// Vertices of all morph targets of a primitive: a small file can name one accessor for all of them.
constexpr std::size_t kMostMorphed = 100'000'000;

/// No PNG, JPEG or WebP holds more bytes of pixels than this for each byte of its own.
constexpr std::uint64_t kMostCompression = 2000;

/// Reads one file; keeps what every message needs.
class AssetReader {
 public:
  explicit AssetReader(const std::filesystem::path& path) : file_(open_gltf(path)) {}

  Asset read(bool with_materials) {
    asset_.generator = model().asset.generator;
    read_scene_name();
    asset_.samples = asset_number(file_, "samples");
    asset_.half_patches = asset_number(file_, "half_patches");
    asset_.boundary_sides = asset_numbers(file_, "boundary_sides");
    asset_.source_triangles = asset_number(file_, "source_triangles");
    asset_.is_fitted = asset_number(file_, "fitted") != 0;
    asset_.cap_triangles = asset_number(file_, "cap_triangles_left_out");
    read_translation();
    if (with_materials) {
      for (std::size_t i = 0; i < model().textures.size(); ++i) asset_.textures.push_back(read_texture(i));
      for (const tinygltf::Material& m : model().materials) asset_.materials.push_back(read_material(m));
    }
    AssetScene scene = read_asset_scene(file_);
    for (const AssetNodes& part : scene.parts) append_part(part);
    asset_.rig = std::move(scene.rig);
    return std::move(asset_);
  }

 private:
  const tinygltf::Model& model() const { return *file_.model; }

  [[noreturn]] void refuse(ExitCode code, const std::string& what) const {
    throw Error(code, fmt::format("{}: {}", file_.name, what));
  }

  void read_scene_name() {
    const int scene = std::max(model().defaultScene, 0);
    if (scene < static_cast<int>(model().scenes.size())) asset_.scene_name = model().scenes[scene].name;
  }

  void read_translation() {
    const tinygltf::Value& extras = model().asset.extras;
    if (!extras.IsObject() || !extras.Has("translation")) return;
    const tinygltf::Value& list = extras.Get("translation");
    for (int axis = 0; axis < 3 && list.IsArray() && list.ArrayLen() == 3; ++axis) {
      const tinygltf::Value& number = list.Get(axis);
      if (number.IsNumber() && std::isfinite(number.GetNumberAsDouble())) {
        asset_.translation[axis] = number.GetNumberAsDouble();
      }
    }
  }

  /// Half a step of an attribute's integers; 0 of floats.
  double rounding_of(const tinygltf::Primitive& primitive, const std::string& name) const {
    const auto at = primitive.attributes.find(name);
    if (at == primitive.attributes.end() || accessor_facts(file_, at->second).is_float) return 0;
    const tinygltf::Accessor& accessor = model().accessors[at->second];
    if (!accessor.normalized) return 0.5;
    const int bits = 8 * tinygltf::GetComponentSizeInBytes(static_cast<uint32_t>(accessor.componentType));
    return 0.5 / (std::pow(2.0, bits - (accessor_facts(file_, at->second).is_signed ? 1 : 0)) - 1);
  }

  void note_rounding(const AssetNodes& part, const tinygltf::Primitive& primitive) {
    double scale = 0;
    const auto note_scale = [&](const Imath::M44d& matrix) {
      for (int axis = 0; axis < 3; ++axis) {
        scale = std::max(scale, Vec3d(matrix[axis][0], matrix[axis][1], matrix[axis][2]).length());
      }
    };
    for (const BodyPlace& place : part.body.places) note_scale(matrix_of(place.placement));
    for (const Imath::M44d& joint : part.joints) note_scale(joint);
    AssetRounding& rounding = asset_.rounding;
    rounding.position = std::max(rounding.position, scale * rounding_of(primitive, "POSITION"));
    for (const char* name : {"NORMAL", "TANGENT"}) {
      rounding.direction = std::max(rounding.direction, rounding_of(primitive, name));
    }
    rounding.texcoord = std::max(rounding.texcoord, rounding_of(primitive, "TEXCOORD_0"));
  }

  /// Adds the part's levels to those of the asset.
  void append_part(const AssetNodes& part) {
    for (std::size_t l = 0; l < part.levels.size(); ++l) {
      for (const tinygltf::Primitive& primitive : model().meshes[model().nodes[part.levels[l]].mesh].primitives) {
        note_rounding(part, primitive);
      }
      AssetLevel level = read_level(part.levels[l], !part.joints.empty());
      level.parts.push_back({0,
                             level.positions.size(),
                             0,
                             level.triangles.size(),
                             {},
                             part.joints,
                             {},
                             part.body.skin,
                             part.body.targets,
                             {},
                             part.body.name});
      for (const BodyPlace& place : part.body.places) {
        level.parts.back().places.push_back(placement_of(counted_from(asset_.translation, matrix_of(place.placement))));
        level.parts.back().nodes.push_back(place.node);
      }
      for (Imath::M44d& joint : level.parts.back().joints) joint = counted_from(asset_.translation, joint);
      if (level.targets.size() != part.body.targets.size()) {
        refuse(ExitCode::kUnusableInput, fmt::format("level {} of \"{}\" has {} morph targets, the finest {}", l,
                                                     part.body.name, level.targets.size(), part.body.targets.size()));
      }
      if (l == asset_.levels.size()) {
        asset_.levels.push_back(std::move(level));
      } else {
        append_level(asset_.levels[l], level);
      }
    }
  }

  void append_level(AssetLevel& to, const AssetLevel& from) const {
    const auto same_kind = [](const auto& a, const auto& b) { return a.empty() == b.empty(); };
    if (!same_kind(to.normals, from.normals) || !same_kind(to.tangents, from.tangents) ||
        !same_kind(to.uvs, from.uvs)) {
      refuse(ExitCode::kUnusableInput, "its parts have different attributes");
    }
    for (AssetPart part : from.parts) {
      part.first_vertex += to.positions.size();
      part.first_triangle += to.triangles.size();
      to.parts.push_back(std::move(part));
    }
    if (!to.influences.empty() || !from.influences.empty()) {
      to.influences.resize(kInfluences.components * to.positions.size(), 0.0F);
      to.influences.insert(to.influences.end(), from.influences.begin(), from.influences.end());
      to.influences.resize(kInfluences.components * (to.positions.size() + from.positions.size()), 0.0F);
    }
    append_targets(to, from);
    if (to.material != from.material || !to.materials.empty() || !from.materials.empty()) {
      to.materials.resize(to.triangles.size(), to.material);
      for (std::size_t t = 0; t < from.triangles.size(); ++t) {
        to.materials.push_back(from.material_of(static_cast<TriangleId>(t)));
      }
    }
    const auto first = static_cast<VertexId>(to.positions.size());
    for (const auto& [a, b, c] : from.triangles) to.triangles.push_back({first + a, first + b, first + c});
    const auto append = [](auto& all, const auto& more) { all.insert(all.end(), more.begin(), more.end()); };
    append(to.positions, from.positions);
    append(to.normals, from.normals);
    append(to.tangents, from.tangents);
    append(to.uvs, from.uvs);
  }

  /// Those that one of the two has fewer of do nothing there.
  static void append_targets(AssetLevel& to, const AssetLevel& from) {
    to.targets.resize(std::max(to.targets.size(), from.targets.size()));
    const std::size_t before = to.positions.size();
    const auto append = [&](std::vector<Vec3f>& all, const std::vector<Vec3f>& more) {
      if (all.empty() && more.empty()) return;
      all.resize(before, Vec3f(0, 0, 0));
      all.insert(all.end(), more.begin(), more.end());
      all.resize(before + from.positions.size(), Vec3f(0, 0, 0));
    };
    for (std::size_t t = 0; t < to.targets.size(); ++t) {
      const AssetTarget more = t < from.targets.size() ? from.targets[t] : AssetTarget();
      append(to.targets[t].offsets, more.offsets);
      append(to.targets[t].normals, more.normals);
      append(to.targets[t].tangents, more.tangents);
    }
  }

  AssetLevel read_level(int node_index, bool is_skinned) const {
    const tinygltf::Node& node = model().nodes[node_index];
    const tinygltf::Mesh& mesh = model().meshes[node.mesh];
    // Resampled triangles, the source's own, or both, each in classes of looks.
    if (mesh.primitives.empty()) {
      refuse(ExitCode::kUnsupported, fmt::format("mesh {} has no primitives", node.mesh));
    }
    AssetLevel level = read_primitive(node.mesh, 0, is_skinned);
    for (int p = 1; p < static_cast<int>(mesh.primitives.size()); ++p) {
      const AssetLevel next = read_primitive(node.mesh, p, is_skinned);
      if (next.targets.size() != level.targets.size()) {
        refuse(ExitCode::kUnusableInput,
               fmt::format("the primitives of mesh {} have different numbers of morph targets", node.mesh));
      }
      append_level(level, next);
    }
    return level;
  }

  AssetLevel read_primitive(int mesh_index, int index, bool is_skinned) const {
    const tinygltf::Mesh& mesh = model().meshes[mesh_index];
    const tinygltf::Primitive& primitive = mesh.primitives[index];
    const std::string place = fmt::format("mesh {} primitive {}", mesh_index, index);
    if (primitive.mode != -1 && primitive.mode != 4) {
      refuse(ExitCode::kUnsupported, place + " is no list of triangles; an asset that Lozenge exported has no others");
    }
    AssetLevel level;
    level.name = mesh.name;
    level.material = primitive.material;
    level.positions = vectors<Vec3f>(primitive.attributes, "POSITION", 3, place);
    if (level.positions.empty()) refuse(ExitCode::kUnusableInput, place + " has no positions");
    level.normals = vectors<Vec3f>(primitive.attributes, "NORMAL", 3, place);
    level.tangents = vectors<Vec4f>(primitive.attributes, "TANGENT", 4, place);
    level.uvs = vectors<Vec2f>(primitive.attributes, "TEXCOORD_0", 2, place);
    for (const std::size_t count : {level.normals.size(), level.tangents.size(), level.uvs.size()}) {
      if (count != 0 && count != level.positions.size()) {
        refuse(ExitCode::kUnusableInput, place + " has attributes of different lengths");
      }
    }
    if (primitive.targets.size() > static_cast<std::size_t>(kMostMorphTargets)) {
      refuse(ExitCode::kUnsupported,
             fmt::format("{} has {} morph targets; an asset that Lozenge exported has at most {}", place,
                         primitive.targets.size(), kMostMorphTargets));
    }
    if (primitive.targets.size() > kMostMorphed / level.positions.size()) {
      refuse(ExitCode::kLimit, fmt::format("{} has {} morph targets of {} vertices, which is more than is read", place,
                                           primitive.targets.size(), level.positions.size()));
    }
    for (const auto& target : primitive.targets) {
      level.targets.push_back(read_target(target, level.positions.size(), place));
    }
    if (is_skinned) {
      level.influences = read_influences(file_, primitive, level.positions.size());
      if (level.influences.empty()) refuse(ExitCode::kUnusableInput, place + " has a skin, but no joints and weights");
    }
    level.triangles = triangles_of(primitive, level.positions.size(), place);
    return level;
  }

  AssetTarget read_target(const std::map<std::string, int>& target, std::size_t vertices,
                          const std::string& place) const {
    AssetTarget read{vectors<Vec3f>(target, "POSITION", 3, place), vectors<Vec3f>(target, "NORMAL", 3, place),
                     vectors<Vec3f>(target, "TANGENT", 3, place)};
    for (const std::size_t count : {read.offsets.size(), read.normals.size(), read.tangents.size()}) {
      if (count == 0 || count == vertices) continue;
      refuse(ExitCode::kUnusableInput, place + " has morph targets of another length than its positions");
    }
    return read;
  }

  template <typename V>
  std::vector<V> vectors(const std::map<std::string, int>& attributes, const std::string& name, int components,
                         const std::string& place) const {
    const auto at = attributes.find(name);
    if (at == attributes.end()) return {};
    const int components_found = accessor_facts(file_, at->second).components;
    if (components_found != components) {
      refuse(ExitCode::kUnusableInput,
             fmt::format("{}, {} has {} components, not {}", place, name, components_found, components));
    }
    const std::vector<float> values = read_floats(file_, at->second);
    std::vector<V> result(values.size() / components);
    for (std::size_t i = 0; i < result.size(); ++i) {
      for (int c = 0; c < components; ++c) result[i][c] = values[i * components + c];
    }
    return result;
  }

  std::vector<std::array<VertexId, 3>> triangles_of(const tinygltf::Primitive& primitive, std::size_t vertices,
                                                    const std::string& place) const {
    std::vector<std::uint32_t> indices;
    if (primitive.indices >= 0) {
      indices = read_indices(file_, primitive.indices, vertices, place);
    } else {
      for (std::size_t v = 0; v < vertices; ++v) indices.push_back(static_cast<std::uint32_t>(v));
    }
    if (indices.size() % 3 != 0) {
      refuse(ExitCode::kUnusableInput,
             fmt::format("{} has {} indices, which is no multiple of 3", place, indices.size()));
    }
    std::vector<std::array<VertexId, 3>> triangles(indices.size() / 3);
    for (std::size_t i = 0; i < indices.size(); ++i) triangles[i / 3][i % 3] = static_cast<VertexId>(indices[i]);
    return triangles;
  }

  AssetMaterial read_material(const tinygltf::Material& m) const {
    AssetMaterial material;
    material.name = m.name;
    material.normal_scale = m.normalTexture.scale;
    material.double_sided = m.doubleSided;
    const std::vector<double>& colour = m.pbrMetallicRoughness.baseColorFactor;
    if (colour.size() >= 3) material.base_colour = {colour[0], colour[1], colour[2]};
    for (std::size_t slot = 1; slot < kMaterialSlots; ++slot) {
      const int texture = texture_in(m, static_cast<MaterialSlot>(slot));
      material.textures[slot] = texture;
      if (texture >= static_cast<int>(asset_.textures.size())) {
        refuse(ExitCode::kUnusableInput,
               fmt::format("material \"{}\" names texture {}, which it doesn't have", m.name, texture));
      }
    }
    return material;
  }

  /// The image of a texture; -1 for none.
  static int source_of(const tinygltf::Texture& texture) {
    const auto webp = texture.extensions.find("EXT_texture_webp");
    const bool has_webp = webp != texture.extensions.end() && webp->second.IsObject() && webp->second.Has("source") &&
                          webp->second.Get("source").IsInt();
    return has_webp ? webp->second.Get("source").GetNumberAsInt() : texture.source;
  }

  AssetTexture read_texture(std::size_t index) const {
    const int source = source_of(model().textures[index]);
    const std::string place = fmt::format("texture {}", index);
    if (source < 0 || source >= static_cast<int>(model().images.size())) {
      refuse(ExitCode::kUnusableInput, place + " has no image");
    }
    const tinygltf::Image& image = model().images[source];
    if (image.bufferView < 0) {
      refuse(ExitCode::kUnsupported, place + " lies outside the file; an asset that Lozenge exported holds its own");
    }
    const tinygltf::BufferView& view = model().bufferViews[image.bufferView];
    const std::vector<unsigned char>& bytes = model().buffers[view.buffer].data;
    AssetTexture texture = decode(bytes.data() + view.byteOffset, view.byteLength, place);
    texture.name = image.name;
    texture.mime_type = image.mimeType;
    return texture;
  }

  AssetTexture decode(const unsigned char* data, std::size_t size, const std::string& place) const {
    if (const auto defect = find_texture_defect({data, size})) {
      refuse(ExitCode::kUnusableInput, fmt::format("{} cannot be decoded: {}", place, *defect));
    }
    OIIO::Filesystem::IOMemReader memory(const_cast<unsigned char*>(data), size);
    OIIO::Filesystem::IOProxy* proxy = &memory;
    OIIO::ImageSpec config;
    config["oiio:UnassociatedAlpha"] = 1;
    // With a configuration, OpenImageIO 2.4 takes the proxy from there alone.
    config.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &proxy);
    const std::string type(read_picture_header({data, size})->mime_type);
    auto input = OIIO::ImageInput::open("texture." + type.substr(type.find('/') + 1), &config, &memory);
    if (!input) {
      refuse(ExitCode::kUnusableInput, fmt::format("{} cannot be decoded: {}", place, OIIO::geterror()));
    }
    const OIIO::ImageSpec& spec = input->spec();
    if (spec.width < 1 || spec.height < 1 || spec.width > kLargestTexture || spec.height > kLargestTexture ||
        spec.nchannels < 1 || spec.nchannels > 4) {
      refuse(ExitCode::kUnusableInput, fmt::format("{} is {} x {} pixels of {} channels; no engine takes that", place,
                                                   spec.width, spec.height, spec.nchannels));
    }
    if (spec.image_bytes(true) / kMostCompression > size) {
      refuse(ExitCode::kUnusableInput,
             fmt::format("{} is too short for {} x {} pixels", place, spec.width, spec.height));
    }
    AssetTexture texture;
    texture.width = spec.width;
    texture.height = spec.height;
    texture.channels = spec.nchannels;
    texture.bits = static_cast<std::int32_t>(spec.format.size() * 8);
    texture.pixels.resize(static_cast<std::size_t>(spec.width) * spec.height * spec.nchannels);
    if (!input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, texture.pixels.data())) {
      refuse(ExitCode::kUnusableInput, fmt::format("{} cannot be decoded: {}", place, input->geterror()));
    }
    return texture;
  }

  GltfFile file_;
  Asset asset_;
};

std::int32_t wrapped(std::int64_t i, std::int32_t size) {
  return static_cast<std::int32_t>(((i % size) + size) % size);
}

template <typename V>
auto interpolated(const std::vector<V>& values, const std::array<VertexId, 3>& corners, const Vec3d& weights) {
  Vec3d sum(0, 0, 0);
  for (int c = 0; c < 3; ++c) {
    const V& v = values[corners[c]];
    sum += Vec3d(v.x, v.y, v.z) * weights[c];
  }
  return sum;
}

}  // namespace

Asset read_asset(const std::filesystem::path& path) { return AssetReader(path).read(true); }

Asset read_asset_shapes(const std::filesystem::path& path) { return AssetReader(path).read(false); }

std::array<float, 4> sample_texture(const AssetTexture& texture, const Vec2d& uv) {
  const double x = uv.x * texture.width - 0.5;
  const double y = uv.y * texture.height - 0.5;
  const auto left = static_cast<std::int64_t>(std::floor(x));
  const auto top = static_cast<std::int64_t>(std::floor(y));
  const double fx = x - static_cast<double>(left);
  const double fy = y - static_cast<double>(top);
  std::array<float, 4> result{};
  for (int corner = 0; corner < 4; ++corner) {
    const std::int32_t i = wrapped(left + corner % 2, texture.width);
    const std::int32_t j = wrapped(top + corner / 2, texture.height);
    const double weight = (corner % 2 ? fx : 1 - fx) * (corner / 2 ? fy : 1 - fy);
    const float* pixel = &texture.pixels[(static_cast<std::size_t>(j) * texture.width + i) * texture.channels];
    for (int c = 0; c < std::min(texture.channels, 4); ++c) result[c] += static_cast<float>(weight * pixel[c]);
  }
  return result;
}

Vec3f mapped_normal(const Asset& asset, const AssetLevel& level, TriangleId t, const Vec3d& weights) {
  const std::array<VertexId, 3>& corners = level.triangles[t];
  const Vec3d n = interpolated(level.normals, corners, weights).normalized();
  const std::int32_t number = level.material_of(t);
  const AssetMaterial* material = number >= 0 ? &asset.materials[number] : nullptr;
  const std::int32_t map = material ? material->texture(MaterialSlot::kNormal) : -1;
  if (map < 0 || level.tangents.empty() || level.uvs.empty()) return Vec3f(n);
  // glTF 2.0, 3.9.3 and 3.7.2.1: texels 0..1 become -1..1, and the bitangent is cross(normal, tangent) * w.
  const Vec3d tangent = interpolated(level.tangents, corners, weights).normalized();
  const Vec3d bitangent = n.cross(tangent) * static_cast<double>(level.tangents[corners[0]].w);
  Vec2d uv(0, 0);
  for (int c = 0; c < 3; ++c) uv += Vec2d(level.uvs[corners[c]]) * weights[c];
  const auto texel = sample_texture(asset.textures[map], uv);
  const double x = (2.0 * texel[0] - 1) * material->normal_scale;
  const double y = (2.0 * texel[1] - 1) * material->normal_scale;
  const double z = 2.0 * texel[2] - 1;
  const Vec3d sum = tangent * x + bitangent * y + n * z;
  return sum.length() > 0 ? Vec3f(sum.normalized()) : Vec3f(n);
}

}  // namespace lozenge
