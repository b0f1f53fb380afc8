// What one material for all of a surface says: which quantities differ from place to place, and so need maps, and the
// factors of all others.
#pragma once

#include <array>

#include "formats/surface/source_mesh.h"

namespace lozenge {

struct Appearance {
  bool has_base_colours = false;  ///< differ
  bool has_alpha = false;         ///< the surface isn't opaque everywhere
  bool has_orm = false;           ///< roughness or metal differ, or the source has occlusion textures
  bool has_emissive = false;      ///< differ
  bool has_normals = false;       ///< the source has normal textures
  /// [role] of extensions: some material has such a texture, or directions that follow from its tangents.
  std::array<bool, kTextureRoles.size()> has_extension_texture{};
  double emissive_strength = 1;  ///< what a map of emission is a share of: the strongest place, where that is above 1
  /// Without textures: what holds everywhere; of what differs, as the first material has it. Where the asset says
  /// nothing of its looks, grey plaster, so that shape is what one sees.
  Material factors;
};

/// Of a surface of which nothing is known.
Appearance plain_appearance();

/// How alpha is used differs from class to class (look_classes.h), and so isn't among the factors.
Appearance appearance_of(const SourceMesh& mesh);

/// Whether someone made its look: it has textures, colours, or materials that differ or aren't grey. Light and shadow
/// are often in it.
bool has_made_look(const SourceMesh& mesh);

/// [material] whether any triangle has it.
std::vector<bool> used_materials(const SourceMesh& mesh);

/// Where its emission is strongest, as a multiple of 1; that of black is 0.
double strongest_emission(const Material& material);

}  // namespace lozenge
