#include "formats/files/readers/gltf/materials.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "formats/files/readers/gltf/images.h"
#include "formats/files/readers/gltf/material_extensions.h"
#include "formats/files/readers/gltf/specular_glossiness.h"
#include "formats/surface/attribute.h"
#include "formats/surface/extension_textures.h"

namespace lozenge {

namespace {

using tinygltf::Value;

constexpr const char* kTransform = "KHR_texture_transform";
constexpr const char* kStrength = "KHR_materials_emissive_strength";
constexpr const char* kSpecularGlossiness = "KHR_materials_pbrSpecularGlossiness";

double in_range(double value, double least, double most, double otherwise) {
  return std::isfinite(value) ? std::clamp(value, least, most) : otherwise;
}

double factor(double value, double otherwise) { return in_range(value, 0, 1, otherwise); }

/// The number under a key; `otherwise` where there is none that is finite.
double number_at(const Value& object, const std::string& key, double otherwise) {
  if (!object.IsObject() || !object.Has(key) || !object.Get(key).IsNumber()) return otherwise;
  const double number = object.Get(key).GetNumberAsDouble();
  return std::isfinite(number) ? number : otherwise;
}

/// -1 where there is none.
int index_at(const Value& object, const std::string& key) {
  return static_cast<int>(std::clamp(number_at(object, key, -1), -1.0, 1e9));
}

Vec2d pair_at(const Value& object, const std::string& key, const Vec2d& otherwise) {
  if (!object.IsObject() || !object.Has(key)) return otherwise;
  const Value& list = object.Get(key);
  if (!list.IsArray() || list.ArrayLen() != 2 || !list.Get(0).IsNumber() || !list.Get(1).IsNumber()) return otherwise;
  const Vec2d pair(list.Get(0).GetNumberAsDouble(), list.Get(1).GetNumberAsDouble());
  return std::isfinite(pair.x) && std::isfinite(pair.y) ? pair : otherwise;
}

Wrap wrap_of(int code) {
  return code == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE     ? Wrap::kClamp
         : code == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT ? Wrap::kMirror
                                                         : Wrap::kRepeat;
}

class MaterialReader {
 public:
  MaterialReader(const GltfFile& file, MemoryBudget& budget, Deviations& deviations, std::vector<std::string>& notes)
      : model_(*file.model), images_(file, budget, deviations, notes), notes_(notes) {}

  Material read(const tinygltf::Material& from) {
    Material material;
    const tinygltf::PbrMetallicRoughness& pbr = from.pbrMetallicRoughness;
    for (int c = 0; c < 4 && pbr.baseColorFactor.size() == 4; ++c) {
      material.base_colour[c] = factor(pbr.baseColorFactor[c], 1);
    }
    material.metallic = factor(pbr.metallicFactor, 1);
    material.roughness = factor(pbr.roughnessFactor, 1);
    const auto old = from.extensions.find(kSpecularGlossiness);
    const bool is_old = old != from.extensions.end() && old->second.IsObject();
    if (is_old) read_specular_glossiness(old->second, material);
    for (int c = 0; c < 3 && from.emissiveFactor.size() == 3; ++c) {
      material.emissive[c] = factor(from.emissiveFactor[c], 0);
    }
    if (const auto at = from.extensions.find(kStrength); at != from.extensions.end()) {
      material.emissive_strength = std::clamp(number_at(at->second, "emissiveStrength", 1), 0.0, 1e6);
    }
    material.normal_scale = in_range(from.normalTexture.scale, -1e3, 1e3, 1);
    material.occlusion_strength = factor(from.occlusionTexture.strength, 1);
    material.alpha_mode = from.alphaMode == "MASK"    ? AlphaMode::kMask
                          : from.alphaMode == "BLEND" ? AlphaMode::kBlend
                                                      : AlphaMode::kOpaque;
    material.alpha_cutoff = in_range(from.alphaCutoff, 0, 1, 0.5);
    std::vector<std::string> without;
    material.extensions = material_extensions(from, without);
    left_out_.insert(without.begin(), without.end());
    left_out_.erase(kStrength);
    if (is_old) left_out_.erase(kSpecularGlossiness);
    if (!is_old) {
      material.texture(TextureRole::kBaseColour) = texture(pbr.baseColorTexture);
      material.texture(TextureRole::kMetallicRoughness) = texture(pbr.metallicRoughnessTexture);
    }
    material.texture(TextureRole::kNormal) = texture(from.normalTexture);
    material.texture(TextureRole::kOcclusion) = texture(from.occlusionTexture);
    material.texture(TextureRole::kEmissive) = texture(from.emissiveTexture);
    for (const ExtensionTexture& row : kExtensionTextures) read_extension_texture(from, row, material);
    return material;
  }

  std::vector<EncodedImage> take_images() { return images_.take(); }

  /// Names of extensions and textures that weren't taken.
  const std::set<std::string>& left_out() const { return left_out_; }

 private:
  void read_extension_texture(const tinygltf::Material& from, const ExtensionTexture& row, Material& material) {
    const auto at = from.extensions.find(std::string(row.extension));
    if (at == from.extensions.end() || !at->second.IsObject()) return;
    if (row.role == TextureRole::kAnisotropy) {
      material.anisotropy_rotation = number_at(at->second, "anisotropyRotation", 0);
    }
    const std::string name(row.texture);
    if (!at->second.Has(name)) return;
    const Value& info = at->second.Get(name);
    material.texture(row.role) = texture(info_of(info));
    if (row.role == TextureRole::kClearcoatNormal) {
      material.clearcoat_normal_scale = in_range(number_at(info, "scale", 1), -1e3, 1e3, 1);
    }
  }

  /// Of a texture that tinygltf doesn't know.
  static tinygltf::TextureInfo info_of(const Value& value) {
    tinygltf::TextureInfo info;
    info.index = index_at(value, "index");
    info.texCoord = static_cast<int>(std::clamp(number_at(value, "texCoord", 0), 0.0, 1000.0));
    if (value.IsObject() && value.Has("extensions") && value.Get("extensions").Has(kTransform)) {
      info.extensions[kTransform] = value.Get("extensions").Get(kTransform);
    }
    return info;
  }

  void read_specular_glossiness(const Value& from, Material& material) {
    SpecularGlossiness old;
    const auto list = [&](const char* key, int count, auto& to) {
      const Value& values = from.Get(key);
      for (int c = 0; c < count && values.IsArray() && static_cast<int>(values.ArrayLen()) == count; ++c) {
        if (values.Get(c).IsNumber()) to[c] = factor(values.Get(c).GetNumberAsDouble(), 1);
      }
    };
    list("diffuseFactor", 4, old.diffuse);
    list("specularFactor", 3, old.specular);
    old.glossiness = factor(number_at(from, "glossinessFactor", 1), 1);
    const bool has_texture = from.Has("specularGlossinessTexture");
    if (has_texture) {
      left_out_.insert(std::string(kSpecularGlossiness) + "'s specularGlossinessTexture");
      // Its factors are made for a texture that isn't read: what stays is a surface that doesn't shine.
      old.specular = {0.04, 0.04, 0.04};
      old.glossiness = std::min(old.glossiness, 0.5);
    }
    const MetallicRoughness found = metallic_roughness_of(old);
    material.base_colour = found.base_colour;
    material.metallic = found.metallic;
    material.roughness = found.roughness;
    if (!from.Has("diffuseTexture")) return;
    material.texture(TextureRole::kBaseColour) = texture(info_of(from.Get("diffuseTexture")));
  }

  template <typename Info>
  TextureUse texture(const Info& info) {
    TextureUse use;
    if (info.index < 0 || info.index >= static_cast<int>(model_.textures.size())) return use;
    const tinygltf::Texture& texture = model_.textures[info.index];
    use.image = images_.find(source_of(texture));
    if (!use.exists()) return TextureUse();
    use.set = std::max(info.texCoord, 0);
    if (texture.sampler >= 0 && texture.sampler < static_cast<int>(model_.samplers.size())) {
      const tinygltf::Sampler& sampler = model_.samplers[texture.sampler];
      use.wrap_u = wrap_of(sampler.wrapS);
      use.wrap_v = wrap_of(sampler.wrapT);
      use.is_blocky = sampler.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST;
    }
    if (const auto at = info.extensions.find(kTransform); at != info.extensions.end()) {
      use.offset = pair_at(at->second, "offset", use.offset);
      use.scale = pair_at(at->second, "scale", use.scale);
      use.rotation = number_at(at->second, "rotation", 0);
      use.set = static_cast<std::int32_t>(std::clamp(number_at(at->second, "texCoord", use.set), 0.0, 1000.0));
    }
    if (use.set >= kTextureCoordinates.sets) {
      notes_.push_back("texture " + std::to_string(info.index) + " left out: it lies by TEXCOORD_" +
                       std::to_string(use.set) + ", and sets 0 to " + std::to_string(kTextureCoordinates.sets - 1) +
                       " are read");
      return TextureUse();
    }
    return use;
  }

  /// The picture that an extension gives is the better one; where it can't be read, the one that all know.
  int source_of(const tinygltf::Texture& texture) {
    const auto at = texture.extensions.find("EXT_texture_webp");
    const int better = at == texture.extensions.end() ? -1 : index_at(at->second, "source");
    if (better >= 0 && images_.find(better) >= 0) return better;
    if (texture.source >= 0) return texture.source;
    // Without a picture that all know, the one that there is says why it isn't read.
    for (const char* name : {"KHR_texture_basisu", "EXT_texture_avif", "MSFT_texture_dds"}) {
      const auto other = texture.extensions.find(name);
      if (other != texture.extensions.end()) return index_at(other->second, "source");
    }
    return -1;
  }

  const tinygltf::Model& model_;
  GltfImages images_;
  std::vector<std::string>& notes_;
  std::set<std::string> left_out_;
};

std::string joined(const std::set<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

}  // namespace

GltfMaterials read_materials(const GltfFile& file, const std::vector<bool>& used, MemoryBudget& budget,
                             Deviations& deviations, std::vector<std::string>& notes) {
  MaterialReader reader(file, budget, deviations, notes);
  GltfMaterials materials;
  for (std::size_t m = 0; m < file.model->materials.size(); ++m) {
    materials.looks.push_back(used[m] ? reader.read(file.model->materials[m]) : Material());
  }
  materials.images = reader.take_images();
  const std::set<std::string>& left_out = reader.left_out();
  if (!left_out.empty()) notes.push_back("materials taken without " + joined(left_out));
  return materials;
}

}  // namespace lozenge
