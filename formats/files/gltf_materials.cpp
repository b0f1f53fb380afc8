#include "formats/files/gltf_materials.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <map>
#include <tuple>

#include "formats/files/readers/gltf/values.h"
#include "formats/surface/extension_textures.h"

namespace lozenge {

namespace {

using tinygltf::Value;

constexpr const char* kTransform = "KHR_texture_transform";

int wrap_code(Wrap wrap) {
  return wrap == Wrap::kClamp    ? TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE
         : wrap == Wrap::kMirror ? TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT
                                 : TINYGLTF_TEXTURE_WRAP_REPEAT;
}

Value pair(const Vec2d& v) { return Value(Value::Array{Value(v.x), Value(v.y)}); }

class MaterialWriter {
 public:
  MaterialWriter(const SourceMesh& mesh, tinygltf::Model& model, GltfBuffer& buffer) : model_(model) {
    for (const EncodedImage& from : mesh.images) {
      tinygltf::Image image;
      image.name = from.name;
      image.mimeType = from.mime_type;
      image.bufferView = buffer.add_bytes(*from.bytes);
      model_.images.push_back(std::move(image));
    }
  }

  void write(const Material& from, tinygltf::Material& to) {
    tinygltf::PbrMetallicRoughness& pbr = to.pbrMetallicRoughness;
    pbr.baseColorFactor = {from.base_colour.x, from.base_colour.y, from.base_colour.z, from.base_colour.w};
    pbr.metallicFactor = from.metallic;
    pbr.roughnessFactor = from.roughness;
    to.emissiveFactor = {from.emissive.x, from.emissive.y, from.emissive.z};
    if (from.emissive_strength != 1) {
      to.extensions["KHR_materials_emissive_strength"] =
          Value(Value::Object{{"emissiveStrength", Value(from.emissive_strength)}});
      use("KHR_materials_emissive_strength");
    }
    to.normalTexture.scale = from.normal_scale;
    to.occlusionTexture.strength = from.occlusion_strength;
    to.alphaMode = from.alpha_mode == AlphaMode::kMask    ? "MASK"
                   : from.alpha_mode == AlphaMode::kBlend ? "BLEND"
                                                          : "OPAQUE";
    to.alphaCutoff = from.alpha_cutoff;
    if (const Value extensions = value_of(from.extensions); extensions.IsObject()) {
      for (const auto& [name, value] : extensions.Get<Value::Object>()) {
        to.extensions[name] = value;
        use(name);
      }
    }
    write(from.texture(TextureRole::kBaseColour), pbr.baseColorTexture);
    write(from.texture(TextureRole::kMetallicRoughness), pbr.metallicRoughnessTexture);
    write(from.texture(TextureRole::kNormal), to.normalTexture);
    write(from.texture(TextureRole::kOcclusion), to.occlusionTexture);
    write(from.texture(TextureRole::kEmissive), to.emissiveTexture);
    for (const ExtensionTexture& row : kExtensionTextures) write(from, row, to);
  }

 private:
  template <typename Info>
  void write(const TextureUse& from, Info& to) {
    if (!from.exists()) return;
    to.index = texture(from);
    to.texCoord = from.set;
    if (is_moved(from)) to.extensions[kTransform] = transform(from);
  }

  void write(const Material& from, const ExtensionTexture& row, tinygltf::Material& to) {
    const auto at = to.extensions.find(std::string(row.extension));
    if (at == to.extensions.end() || !at->second.IsObject()) return;
    auto& extension = at->second.Get<Value::Object>();
    if (row.role == TextureRole::kAnisotropy && from.anisotropy_rotation != 0) {
      extension["anisotropyRotation"] = Value(from.anisotropy_rotation);
    }
    const TextureUse& use = from.texture(row.role);
    if (!use.exists()) return;
    Value::Object info{{"index", Value(texture(use))}, {"texCoord", Value(use.set)}};
    if (is_moved(use)) info["extensions"] = Value(Value::Object{{kTransform, transform(use)}});
    if (row.role == TextureRole::kClearcoatNormal) info["scale"] = Value(from.clearcoat_normal_scale);
    extension[std::string(row.texture)] = Value(std::move(info));
  }

  static bool is_moved(const TextureUse& from) {
    return from.offset != Vec2d(0, 0) || from.rotation != 0 || from.scale != Vec2d(1, 1);
  }

  Value transform(const TextureUse& from) {
    use(kTransform);
    return Value(
        Value::Object{{"offset", pair(from.offset)}, {"rotation", Value(from.rotation)}, {"scale", pair(from.scale)}});
  }

  /// The texture of this image and sampler.
  int texture(const TextureUse& use_of_image) {
    const auto [at, is_new] =
        textures_.try_emplace({use_of_image.image, sampler(use_of_image)}, static_cast<int>(model_.textures.size()));
    if (!is_new) return at->second;
    tinygltf::Texture texture;
    texture.sampler = at->first.second;
    texture.source = use_of_image.image;
    if (model_.images[use_of_image.image].mimeType == "image/webp") {
      texture.extensions["EXT_texture_webp"] = Value(Value::Object{{"source", Value(texture.source)}});
      texture.source = -1;
      use("EXT_texture_webp");
    }
    model_.textures.push_back(std::move(texture));
    return at->second;
  }

  int sampler(const TextureUse& texture) {
    tinygltf::Sampler sampler;
    sampler.wrapS = wrap_code(texture.wrap_u);
    sampler.wrapT = wrap_code(texture.wrap_v);
    sampler.magFilter = texture.is_blocky ? TINYGLTF_TEXTURE_FILTER_NEAREST : TINYGLTF_TEXTURE_FILTER_LINEAR;
    const auto [at, is_new] = samplers_.try_emplace({sampler.wrapS, sampler.wrapT, sampler.magFilter},
                                                    static_cast<int>(model_.samplers.size()));
    if (is_new) model_.samplers.push_back(std::move(sampler));
    return at->second;
  }

  void use(const std::string& extension) {
    std::vector<std::string>& used = model_.extensionsUsed;
    if (std::find(used.begin(), used.end(), extension) == used.end()) used.push_back(extension);
  }

  tinygltf::Model& model_;
  std::map<std::pair<int, int>, int> textures_;  ///< [image, sampler]
  std::map<std::tuple<int, int, int>, int> samplers_;
};

}  // namespace

void add_materials(const SourceMesh& mesh, tinygltf::Model& model, GltfBuffer& buffer) {
  MaterialWriter writer(mesh, model, buffer);
  for (std::size_t m = 0; m < mesh.material_names.size(); ++m) {
    tinygltf::Material& material = model.materials.emplace_back();
    material.name = mesh.material_names[m];
    material.doubleSided = !mesh.double_sided.empty() && mesh.double_sided[m];
    if (!mesh.material_looks.empty()) writer.write(mesh.material_looks[m], material);
  }
}

}  // namespace lozenge
