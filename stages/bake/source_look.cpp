#include "stages/bake/source_look.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "formats/surface/extension_textures.h"

namespace lozenge {

namespace {

Vec4d product(const Vec4d& a, const Vec4d& b) { return {a.x * b.x, a.y * b.y, a.z * b.z, a.w * b.w}; }

Vec2d mixture(const AttributeStream& stream, TriangleId t, const Vec3d& weights) {
  Vec2d sum(0, 0);
  for (std::size_t c = 0; c < 3; ++c) {
    sum += Vec2d(vector_at<Vec2f>(stream, 3 * static_cast<std::size_t>(t) + c)) * weights[static_cast<int>(c)];
  }
  return sum;
}

/// Coordinates of textures that repeat may be far from 0, where floats are coarse.
Vec2d near_zero(const Vec2d& place) {
  // Two repetitions of a mirrored texture are a period.
  return {place.x - 2 * std::floor(place.x / 2), place.y - 2 * std::floor(place.y / 2)};
}

TextureOfTangents tangents_of(TextureRole role) {
  return [role](const Material& material) {
    const TextureUse& use = material.texture(role);
    return use.exists() ? std::optional(use) : std::nullopt;
  };
}

/// KHR_materials_anisotropy: by the coordinates of the normal texture; where there is none, those of its own; else the
/// first set.
std::optional<TextureUse> tangents_of_anisotropy(const Material& material) {
  if (!has_extension(material, kAnisotropyExtension)) return std::nullopt;
  for (const TextureRole role : {TextureRole::kNormal, TextureRole::kAnisotropy}) {
    if (material.texture(role).exists()) return material.texture(role);
  }
  return TextureUse();
}

}  // namespace

bool SourceFootprint::is_inside() const {
  for (int c = 0; c < 3; ++c) {
    if (at.weights[c] < 0.5 * (std::abs(across[c]) + std::abs(down[c]))) return false;
  }
  return true;
}

SourceLook::SourceLook(const SourceMesh& mesh, const ShadingNormals& normals, const Textures* textures)
    : mesh_(mesh),
      normals_(normals),
      textures_(textures),
      appearance_(appearance_of(mesh)),
      colours_(find_stream(mesh.corner_attributes, kColors)) {
  for (const Material& material : mesh.material_looks) {
    auto& of_material = coordinates_.emplace_back();
    for (const TextureRole role : kTextureRoles) {
      const TextureUse& use = material.texture(role);
      const bool can_be_read = textures != nullptr && use.exists() && textures->can_look_up(use, role);
      of_material[static_cast<std::size_t>(role)] =
          can_be_read ? find_stream(mesh.corner_attributes, kTextureCoordinates, use.set) : nullptr;
    }
  }
  const auto is_baked = [&](TextureRole role) {
    return appearance_.has_extension_texture[static_cast<std::size_t>(role)];
  };
  if (appearance_.has_normals && textures != nullptr) {
    tangents_ = std::make_unique<SourceTangents>(mesh, normals, tangents_of(TextureRole::kNormal));
  }
  if (is_baked(TextureRole::kClearcoatNormal) && textures != nullptr) {
    clearcoat_tangents_ = std::make_unique<SourceTangents>(mesh, normals, tangents_of(TextureRole::kClearcoatNormal));
  }
  if (is_baked(TextureRole::kAnisotropy)) {
    anisotropy_tangents_ = std::make_unique<SourceTangents>(mesh, normals, tangents_of_anisotropy);
  }
}

const Material& SourceLook::material_of(TriangleId t) const {
  return mesh_.material_looks.empty() ? appearance_.factors : mesh_.material_looks[mesh_.materials[t]];
}

const AttributeStream* SourceLook::coordinates_of(TriangleId t, TextureRole role) const {
  return coordinates_.empty() ? nullptr : coordinates_[mesh_.materials[t]][static_cast<std::size_t>(role)];
}

Vec4d SourceLook::texture(const SourceFootprint& place, TextureRole role) const {
  const TriangleId t = place.at.triangle;
  const AttributeStream* coordinates = coordinates_of(t, role);
  if (coordinates == nullptr) return {1, 1, 1, 1};
  const AttributeStream& stream = *coordinates;
  const TextureUse& use = material_of(t).texture(role);
  const Vec2d where = place_in_texture(use, mixture(stream, t, place.at.weights));
  TextureFootprint footprint{where, step_in_texture(use, mixture(stream, t, place.across)),
                             step_in_texture(use, mixture(stream, t, place.down))};
  if (use.wrap_u != Wrap::kClamp) footprint.place.x = near_zero(where).x;
  if (use.wrap_v != Wrap::kClamp) footprint.place.y = near_zero(where).y;
  const Vec4f value = textures_->look_up(use, role, footprint);
  return {value.x, value.y, value.z, value.w};
}

Vec4d SourceLook::base_colour(const SourceFootprint& place) const {
  const TriangleId t = place.at.triangle;
  const Material& material = material_of(t);
  Vec4d colour = product(material.base_colour, texture(place, TextureRole::kBaseColour));
  if (colours_ != nullptr) {
    Vec4d of_vertices(0, 0, 0, 0);
    for (std::size_t c = 0; c < 3; ++c) {
      const float* value = colours_->at(3 * static_cast<std::size_t>(t) + c);
      of_vertices += Vec4d(value[0], value[1], value[2], value[3]) * place.at.weights[static_cast<int>(c)];
    }
    colour = product(colour, of_vertices);
  }
  if (material.alpha_mode == AlphaMode::kOpaque) {
    colour.w = 1;
  } else if (material.alpha_mode == AlphaMode::kMask && material.alpha_cutoff > 0) {
    colour.w = std::min(1.0, 0.5 * colour.w / material.alpha_cutoff);
  }
  return colour;
}

OcclusionRoughnessMetal SourceLook::occlusion_roughness_metal(const SourceFootprint& place) const {
  const Material& material = material_of(place.at.triangle);
  const Vec4d metallic_roughness = texture(place, TextureRole::kMetallicRoughness);
  const double occlusion = texture(place, TextureRole::kOcclusion).x;
  return {1 + material.occlusion_strength * (occlusion - 1), material.roughness * metallic_roughness.y,
          material.metallic * metallic_roughness.z};
}

Vec3d SourceLook::emissive(const SourceFootprint& place) const {
  const Material& material = material_of(place.at.triangle);
  const double strength = material.emissive_strength / appearance_.emissive_strength;
  const Vec4d value = texture(place, TextureRole::kEmissive);
  return Vec3d(material.emissive.x * value.x, material.emissive.y * value.y, material.emissive.z * value.z) * strength;
}

bool SourceLook::has_normal_texture(TriangleId t) const {
  return tangents_ && coordinates_of(t, TextureRole::kNormal) != nullptr;
}

Vec3d SourceLook::normal(const SourceFootprint& place) const {
  const TriangleId t = place.at.triangle;
  if (!has_normal_texture(t)) return Vec3d(normals_.at(t, place.at.weights));
  return turned(place, TextureRole::kNormal, material_of(t).normal_scale, *tangents_);
}

Vec3d SourceLook::clearcoat_normal(const SourceFootprint& place) const {
  const TriangleId t = place.at.triangle;
  const bool has_texture = clearcoat_tangents_ && coordinates_of(t, TextureRole::kClearcoatNormal) != nullptr;
  if (!has_texture) return Vec3d(normals_.at(t, place.at.weights));
  return turned(place, TextureRole::kClearcoatNormal, material_of(t).clearcoat_normal_scale, *clearcoat_tangents_);
}

Vec3d SourceLook::turned(const SourceFootprint& place, TextureRole role, double scale,
                         const SourceTangents& tangents) const {
  const Vec4d value = texture(place, role);
  // glTF 2.0, 3.9.3: 0 to 1 means -1 to 1, and the scale is that of x and y.
  const Vec3d texel((2 * value.x - 1) * scale, (2 * value.y - 1) * scale, 2 * value.z - 1);
  const Vec3d shading(normals_.at(place.at.triangle, place.at.weights));
  return tangents.to_object(place.at.triangle, place.at.weights, shading, texel);
}

Vec3d SourceLook::anisotropy(const SourceFootprint& place) const {
  const TriangleId t = place.at.triangle;
  const Material& material = material_of(t);
  if (!anisotropy_tangents_ || !has_extension(material, kAnisotropyExtension)) return {0, 0, 0};
  // KHR_materials_anisotropy: red and green are the direction, blue how strong; without a texture along the tangent.
  Vec2d along(1, 0);
  double strength = 1;
  if (coordinates_of(t, TextureRole::kAnisotropy) != nullptr) {
    const Vec4d value = texture(place, TextureRole::kAnisotropy);
    along = {2 * value.x - 1, 2 * value.y - 1};
    strength = value.z;
  }
  const double c = std::cos(material.anisotropy_rotation);
  const double s = std::sin(material.anisotropy_rotation);
  const Vec3d texel(c * along.x - s * along.y, s * along.x + c * along.y, 0);
  if (!(texel.length() > 0)) return {0, 0, 0};
  const Vec3d shading(normals_.at(t, place.at.weights));
  const Vec3d direction = anisotropy_tangents_->to_object(t, place.at.weights, shading, texel);
  return direction.dot(shading) < 0.5 ? direction * strength : Vec3d(0, 0, 0);  // else it has no tangents
}

}  // namespace lozenge
