// What a surface looks like, as glTF's core material says it: factors, and the textures that multiply them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "formats/base/vector.h"

namespace lozenge {

/// A picture as its file holds it, PNG, JPEG or WebP. Copies share the bytes.
struct EncodedImage {
  std::string name;  ///< in the asset; may be empty
  std::string mime_type;
  std::shared_ptr<const std::vector<unsigned char>> bytes;
};

/// What lies beyond the texture's border.
enum class Wrap : std::uint8_t { kRepeat, kMirror, kClamp };

/// A picture, and how a material lays it on the surface.
struct TextureUse {
  std::int32_t image = -1;  ///< of SourceMesh::images; -1 where there is no texture
  std::int32_t set = 0;     ///< of texture coordinates
  Wrap wrap_u = Wrap::kRepeat;
  Wrap wrap_v = Wrap::kRepeat;
  bool is_blocky = false;  ///< magnified without interpolation (glTF's NEAREST)
  // KHR_texture_transform: texture coordinates are scaled, turned counter-clockwise (radians), moved.
  Vec2d offset{0, 0};
  double rotation = 0;
  Vec2d scale{1, 1};

  bool exists() const { return image >= 0; }
  bool operator==(const TextureUse&) const = default;
};

/// Where in the texture a texture coordinate of the surface lies.
Vec2d place_in_texture(const TextureUse& texture, const Vec2d& coordinate);
/// The same of a difference of texture coordinates.
Vec2d step_in_texture(const TextureUse& texture, const Vec2d& step);

/// What a texture of a material is for.
enum class TextureRole : std::uint8_t {
  kBaseColour,
  kMetallicRoughness,
  kNormal,
  kOcclusion,
  kEmissive,
  // Of extensions (extension_textures.h).
  kClearcoat,
  kClearcoatRoughness,
  kClearcoatNormal,
  kSheenColour,
  kSheenRoughness,
  kSpecular,
  kSpecularColour,
  kTransmission,
  kThickness,
  kIridescence,
  kIridescenceThickness,
  kAnisotropy,
};
inline constexpr std::array kTextureRoles = [] {
  std::array<TextureRole, static_cast<std::size_t>(TextureRole::kAnisotropy) + 1> roles{};
  for (std::size_t r = 0; r < roles.size(); ++r) roles[r] = static_cast<TextureRole>(r);
  return roles;
}();

/// Whether its numbers are colours, stored as sRGB, or quantities, stored as they are.
constexpr bool holds_colours(TextureRole role) {
  return role == TextureRole::kBaseColour || role == TextureRole::kEmissive || role == TextureRole::kSheenColour ||
         role == TextureRole::kSpecularColour;
}

enum class AlphaMode : std::uint8_t { kOpaque, kMask, kBlend };

/// The defaults are glTF's. Colours are linear.
struct Material {
  Vec4d base_colour{1, 1, 1, 1};
  double metallic = 1;
  double roughness = 1;
  Vec3d emissive{0, 0, 0};
  double emissive_strength = 1;   ///< KHR_materials_emissive_strength
  double normal_scale = 1;        ///< of x and y of the normal texture
  double occlusion_strength = 1;  ///< how much the occlusion texture darkens: 0 not at all, 1 all that it says
  AlphaMode alpha_mode = AlphaMode::kOpaque;
  double alpha_cutoff = 0.5;          ///< of kMask: what has less isn't there
  double clearcoat_normal_scale = 1;  ///< of x and y of the clearcoat's normal texture
  double anisotropy_rotation = 0;     ///< radians, counter-clockwise from the tangent
  /// glTF's extensions of materials, as the text of a JSON object by their names: what they say in numbers, but for the
  /// two above, of which maps of directions take care; empty where there are none.
  std::string extensions;
  std::array<TextureUse, kTextureRoles.size()> textures;

  const TextureUse& texture(TextureRole role) const { return textures[static_cast<std::size_t>(role)]; }
  TextureUse& texture(TextureRole role) { return textures[static_cast<std::size_t>(role)]; }
  bool operator==(const Material&) const = default;
};

}  // namespace lozenge
