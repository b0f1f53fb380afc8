// The maps that can be baked: one table that says all that is to be known of each. Whoever makes, stores, checks, ships
// or draws a map reads it here. A new map is an enumerator, a row, and a baking function (stages/bake/bake.cpp).
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "formats/surface/extension_textures.h"

namespace lozenge {

enum class MapKind {
  kTangentNormal,
  kObjectNormal,
  kOcclusion,
  kPosition,
  kBaseColour,
  kOcclusionRoughnessMetal,
  kEmissive,
  kSourceNormal,
  // Of the extensions of materials.
  kClearcoat,
  kClearcoatNormal,
  kSheen,
  kSpecular,
  kTransmission,
  kIridescence,
  kAnisotropy,
};

/// What a map's numbers are, and so how the integers of a PNG, from 0 to 1, hold them.
enum class MapValues {
  kDirections,  ///< components of unit vectors, from -1 to 1: halved and shifted, as glTF's normal maps are (y up in
                ///< the picture: the OpenGL convention)
  kShares,      ///< from 0 to 1, as they are
  kNumbers,     ///< any that are finite: in a PNG there is no room for them, only in the floats of an EXR
};

/// How integers are spaced. Texels in memory, and those of an EXR, are always linear.
enum class ColourSpace {
  kLinear,
  kSrgb,  ///< all channels but the fourth, which is a share of cover
};

/// What glTF's material takes a map for.
enum class MaterialSlot {
  kNone,
  kBaseColour,
  kNormal,
  kOcclusion,
  kMetallicRoughness,
  kEmissive,
  // Of extensions, in the order of their TextureRoles.
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
inline constexpr std::size_t kMaterialSlots = static_cast<std::size_t>(MaterialSlot::kAnisotropy) + 1;

/// Null where it is one of glTF's core material, or none.
constexpr const ExtensionTexture* extension_texture(MaterialSlot slot) {
  return slot < MaterialSlot::kClearcoat
             ? nullptr
             : &kExtensionTextures[static_cast<std::size_t>(slot) - static_cast<std::size_t>(MaterialSlot::kClearcoat)];
}

/// Which tangent frames a map's numbers are in; with others they are wrong.
enum class Frames {
  kNone,
  kLevel,   ///< of the level of detail that it was baked for, and of all others that take over its frames
  kSource,  ///< of the source's own triangles in the atlas
};

struct MapTraits {
  MapKind kind;
  std::string_view name;       ///< in reports, messages, and the map's file itself
  std::string_view option;     ///< on the command line
  std::string_view file_part;  ///< "normal" in NAME.normal.png; in the asset, the texture's name
  std::int32_t channels;
  std::array<float, 4> neutral;  ///< [channel] where no patch lies
  MapValues values;
  ColourSpace colours;
  /// Where it goes in the asset; more than one where it holds more than one quantity (glTF has occlusion, roughness and
  /// metal in the channels of one image). None: a file of its own is all that there is.
  std::array<MaterialSlot, 2> slots;
  Frames frames = Frames::kNone;
  std::int32_t fewest_channels = 0;  ///< where it may do without the last ones; or 0
  /// Of a map that is the same everywhere: the channels, from the first on, that the material has no factors for, and
  /// so must be neutral if it is to do without the map. Negative where it never does.
  std::int32_t channels_without_factor = -1;
};

/// In the order of MapKind, which is also the order of an asset's textures.
// clang-format off
inline constexpr std::array kMapKinds{
    MapTraits{MapKind::kTangentNormal, "tangent-normal", "normal",        "normal",        3, {0, 0, 1},
              MapValues::kDirections, ColourSpace::kLinear, {MaterialSlot::kNormal},     Frames::kLevel},
    MapTraits{MapKind::kObjectNormal,  "object-normal",  "object-normal", "object_normal", 3, {0, 0, 0},
              MapValues::kDirections, ColourSpace::kLinear, {}},
    MapTraits{MapKind::kOcclusion,     "occlusion",      "occlusion",     "occlusion",     1, {1},
              MapValues::kShares,     ColourSpace::kLinear, {MaterialSlot::kOcclusion}},
    MapTraits{MapKind::kPosition,      "position",       "position",      "position",      3, {0, 0, 0},
              MapValues::kNumbers,    ColourSpace::kLinear, {}},
    MapTraits{MapKind::kBaseColour,    "base-colour",    "base-color",    "basecolor",     4, {1, 1, 1, 1},
              MapValues::kShares,     ColourSpace::kSrgb,   {MaterialSlot::kBaseColour}, Frames::kNone, 3, 0},
    MapTraits{MapKind::kOcclusionRoughnessMetal, "occlusion-roughness-metallic", "orm", "orm", 3, {1, 1, 1},
              MapValues::kShares,     ColourSpace::kLinear, {MaterialSlot::kOcclusion, MaterialSlot::kMetallicRoughness},
              Frames::kNone, 0, 1},
    MapTraits{MapKind::kEmissive,      "emissive",       "emissive",      "emissive",      3, {0, 0, 0},
              MapValues::kShares,     ColourSpace::kSrgb,   {MaterialSlot::kEmissive}, Frames::kNone, 0, 0},
    MapTraits{MapKind::kSourceNormal,  "source-normal",  "source-normal", "source_normal", 3, {0, 0, 1},
              MapValues::kDirections, ColourSpace::kLinear, {MaterialSlot::kNormal},     Frames::kSource},
    // Textures of extensions have their channels where glTF looks for them; numbers are shares of the extension's factor.
    MapTraits{MapKind::kClearcoat,     "clearcoat",      "clearcoat",     "clearcoat",     3, {1, 1, 1},
              MapValues::kShares,     ColourSpace::kLinear, {MaterialSlot::kClearcoat, MaterialSlot::kClearcoatRoughness},
              Frames::kNone, 0, 0},
    MapTraits{MapKind::kClearcoatNormal, "clearcoat-normal", "clearcoat-normal", "clearcoat_normal", 3, {0, 0, 1},
              MapValues::kDirections, ColourSpace::kLinear, {MaterialSlot::kClearcoatNormal}, Frames::kNone, 0, 3},
    MapTraits{MapKind::kSheen,         "sheen",          "sheen",         "sheen",         4, {1, 1, 1, 1},
              MapValues::kShares,     ColourSpace::kSrgb,   {MaterialSlot::kSheenColour, MaterialSlot::kSheenRoughness},
              Frames::kNone, 3, 0},
    MapTraits{MapKind::kSpecular,      "specular",       "specular",      "specular",      4, {1, 1, 1, 1},
              MapValues::kShares,     ColourSpace::kSrgb,   {MaterialSlot::kSpecular, MaterialSlot::kSpecularColour},
              Frames::kNone, 3, 0},
    MapTraits{MapKind::kTransmission,  "transmission",   "transmission",  "transmission",  3, {1, 1, 1},
              MapValues::kShares,     ColourSpace::kLinear, {MaterialSlot::kTransmission, MaterialSlot::kThickness},
              Frames::kNone, 0, 0},
    MapTraits{MapKind::kIridescence,   "iridescence",    "iridescence",   "iridescence",   3, {1, 1, 1},
              MapValues::kShares,     ColourSpace::kLinear, {MaterialSlot::kIridescence, MaterialSlot::kIridescenceThickness},
              Frames::kNone, 0, 0},
    // Of the direction, halved and shifted, x and y; and how strong.
    MapTraits{MapKind::kAnisotropy,    "anisotropy",     "anisotropy",    "anisotropy",    3, {1, 0.5F, 1},
              MapValues::kShares,     ColourSpace::kLinear, {MaterialSlot::kAnisotropy}, Frames::kNone, 0, 2},
};
// clang-format on

/// Whether a map of this kind may have so many channels.
constexpr bool may_have_channels(const MapTraits& traits, std::int32_t channels) {
  return channels == traits.channels || (channels != 0 && channels == traits.fewest_channels);
}

/// Normals in tangent space, of which people disagree where y points to.
constexpr bool holds_tangent_space_normals(const MapTraits& traits) {
  return traits.values == MapValues::kDirections && traits.slots.front() != MaterialSlot::kNone;
}

constexpr const MapTraits& traits_of(MapKind kind) { return kMapKinds[static_cast<std::size_t>(kind)]; }

/// Least and largest of the numbers that a map may hold; infinite where any will do.
struct NumberRange {
  float least;
  float most;
};
NumberRange range_of(MapValues values);

/// Whether the numbers fit in a PNG.
constexpr bool fits_integers(const MapTraits& traits) { return traits.values != MapValues::kNumbers; }

/// Bits a channel in a PNG: as many as are asked for where the steps of 8 would show, which they do in directions; of
/// all else 8.
constexpr int bits_in_png(const MapTraits& traits, int bits_of_directions) {
  return traits.values == MapValues::kDirections ? bits_of_directions : 8;
}

/// The share of the largest integer, from 0 to 1, that stands for a number in a PNG. \pre fits_integers(traits)
double stored_share(const MapTraits& traits, std::int32_t channel, double value);
/// The number that it stands for.
double value_of_share(const MapTraits& traits, std::int32_t channel, double share);

}  // namespace lozenge
