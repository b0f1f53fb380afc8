// The textures of glTF's extensions of materials. One table says all that is to be known of each; whoever reads, writes
// or bakes one reads it here. A further one is a TextureRole, a row, and a place in a map
// (formats/patches/map_kinds.h).
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <string_view>

#include "formats/surface/material.h"

namespace lozenge {

struct ExtensionTexture {
  TextureRole role;
  std::string_view extension;
  std::string_view texture;  ///< its name in the extension's object
  /// The number, or three, that it multiplies there; empty where there is none.
  std::string_view factor;
  double usual_factor;         ///< where the extension doesn't say
  std::int32_t first_channel;  ///< of the picture, that it is in
  std::int32_t channels;
};

inline constexpr std::string_view kClearcoatExtension = "KHR_materials_clearcoat";
inline constexpr std::string_view kSheenExtension = "KHR_materials_sheen";
inline constexpr std::string_view kSpecularExtension = "KHR_materials_specular";
inline constexpr std::string_view kIridescenceExtension = "KHR_materials_iridescence";
inline constexpr std::string_view kAnisotropyExtension = "KHR_materials_anisotropy";

/// In the order of TextureRole.
// clang-format off
inline constexpr std::array kExtensionTextures{
    ExtensionTexture{TextureRole::kClearcoat,            kClearcoatExtension,          "clearcoatTexture",            "clearcoatFactor",             0,   0, 1},
    ExtensionTexture{TextureRole::kClearcoatRoughness,   kClearcoatExtension,          "clearcoatRoughnessTexture",   "clearcoatRoughnessFactor",    0,   1, 1},
    ExtensionTexture{TextureRole::kClearcoatNormal,      kClearcoatExtension,          "clearcoatNormalTexture",      "",                            1,   0, 3},
    ExtensionTexture{TextureRole::kSheenColour,          kSheenExtension,              "sheenColorTexture",           "sheenColorFactor",            0,   0, 3},
    ExtensionTexture{TextureRole::kSheenRoughness,       kSheenExtension,              "sheenRoughnessTexture",       "sheenRoughnessFactor",        0,   3, 1},
    ExtensionTexture{TextureRole::kSpecular,             kSpecularExtension,           "specularTexture",             "specularFactor",              1,   3, 1},
    ExtensionTexture{TextureRole::kSpecularColour,       kSpecularExtension,           "specularColorTexture",        "specularColorFactor",         1,   0, 3},
    ExtensionTexture{TextureRole::kTransmission,         "KHR_materials_transmission", "transmissionTexture",         "transmissionFactor",          0,   0, 1},
    ExtensionTexture{TextureRole::kThickness,            "KHR_materials_volume",       "thicknessTexture",            "thicknessFactor",             0,   1, 1},
    ExtensionTexture{TextureRole::kIridescence,          kIridescenceExtension,        "iridescenceTexture",          "iridescenceFactor",           0,   0, 1},
    ExtensionTexture{TextureRole::kIridescenceThickness, kIridescenceExtension,        "iridescenceThicknessTexture", "iridescenceThicknessMaximum", 400, 1, 1},
    ExtensionTexture{TextureRole::kAnisotropy,           kAnisotropyExtension,         "anisotropyTexture",           "anisotropyStrength",          0,   2, 1},
};
// clang-format on

inline constexpr TextureRole kFirstExtensionTexture = TextureRole::kClearcoat;

/// Null where glTF's core material has the texture.
constexpr const ExtensionTexture* extension_texture(TextureRole role) {
  return role < kFirstExtensionTexture
             ? nullptr
             : &kExtensionTextures[static_cast<std::size_t>(role) - static_cast<std::size_t>(kFirstExtensionTexture)];
}

static_assert(std::all_of(kExtensionTextures.begin(), kExtensionTextures.end(),
                          [](const ExtensionTexture& row) { return extension_texture(row.role) == &row; }));

/// Whether the material has the extension (Material::extensions names it).
inline bool has_extension(const Material& material, std::string_view extension) {
  return material.extensions.find(extension) != std::string::npos;
}

}  // namespace lozenge
