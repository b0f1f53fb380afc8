// What the source looks like at a point: its material's factors, its textures over a footprint, its colours.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "formats/domain/source_locator.h"
#include "formats/surface/appearance.h"
#include "formats/surface/textures.h"
#include "stages/bake/source_tangents.h"

namespace lozenge {

/// A parallelogram on the plane of a source triangle: its middle, and how the weights change along its sides.
struct SourceFootprint {
  SourcePoint at;
  Vec3d across{0, 0, 0};
  Vec3d down{0, 0, 0};

  /// Whether all of it lies on the triangle.
  bool is_inside() const;
};

/// Occlusion as the source's texture has it, roughness, metal.
using OcclusionRoughnessMetal = Vec3d;

class SourceLook {
 public:
  /// Keeps references to all. \param textures  null where there are none: materials are their factors alone
  SourceLook(const SourceMesh& mesh, const ShadingNormals& normals, const Textures* textures);

  const Appearance& appearance() const { return appearance_; }

  /// Linear RGBA, colours of the source's vertices included. Alpha is 1 where the material is opaque, and where it
  /// is a mask, it is so scaled that what isn't there has less than 0.5.
  Vec4d base_colour(const SourceFootprint& place) const;
  OcclusionRoughnessMetal occlusion_roughness_metal(const SourceFootprint& place) const;
  /// Linear, as a share of the appearance's strength.
  Vec3d emissive(const SourceFootprint& place) const;
  /// The numbers that an extension's texture has there, in its own channels; ones where there is none.
  Vec4d extension(const SourceFootprint& place, TextureRole role) const { return texture(place, role); }
  /// Unit, in the space of the asset: the shading normal, turned as the normal texture says.
  Vec3d normal(const SourceFootprint& place) const;
  /// The same of the clearcoat's normal texture.
  Vec3d clearcoat_normal(const SourceFootprint& place) const;
  /// The direction along which the surface is brushed, in the space of the asset, as long as its texture says it is
  /// strong, from 0 to 1; 0 where the material has no anisotropy.
  Vec3d anisotropy(const SourceFootprint& place) const;
  /// Whether `normal` asks a texture there.
  bool has_normal_texture(TriangleId t) const;

 private:
  const Material& material_of(TriangleId t) const;
  /// Ones where the material has no such texture.
  Vec4d texture(const SourceFootprint& place, TextureRole role) const;
  /// The coordinates of the triangle's texture; null where its material has none that can be looked up.
  const AttributeStream* coordinates_of(TriangleId t, TextureRole role) const;

  const SourceMesh& mesh_;
  const ShadingNormals& normals_;
  const Textures* textures_;
  Appearance appearance_;
  const AttributeStream* colours_;
  std::vector<std::array<const AttributeStream*, kTextureRoles.size()>> coordinates_;  ///< [material][role]
  Vec3d turned(const SourceFootprint& place, TextureRole role, double scale, const SourceTangents& tangents) const;

  // Null where no material needs them.
  std::unique_ptr<SourceTangents> tangents_;
  std::unique_ptr<SourceTangents> clearcoat_tangents_;
  std::unique_ptr<SourceTangents> anisotropy_tangents_;
};

}  // namespace lozenge
