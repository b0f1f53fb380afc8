// Tangents of the source, that its directions in textures are told by: normal textures, and which way a surface is
// brushed.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "formats/base/vector.h"
#include "formats/surface/source_mesh.h"

namespace lozenge {

/// The texture by whose coordinates a material's tangents are made; nothing where it needs none.
using TextureOfTangents = std::function<std::optional<TextureUse>(const Material&)>;

/// At corners: the asset's own, where it has any; else made of the texture coordinates of a texture of each triangle's
/// own material, as it lies on the surface, the way that glTF asks for where vertices have no tangents (MikkTSpace, by
/// its description): each triangle's direction of growing u, laid into the tangent plane of the corner, and the mean of
/// those of all triangles around the vertex that agree in normal, texture coordinates and handedness, weighted by their
/// angles.
class SourceTangents {
 public:
  /// Keeps references to both.
  SourceTangents(const SourceMesh& mesh, const ShadingNormals& normals, const TextureOfTangents& texture_of);

  /// The direction that a texture's value, of components from -1 to 1, means at a point, unit; `normal` where the
  /// surface has no tangents.
  /// \param normal  unit, the shading normal there
  Vec3d to_object(TriangleId t, const Vec3d& weights, const Vec3d& normal, const Vec3d& texel) const;

 private:
  /// \return false where the triangle has none of its own
  bool take(const AttributeStream& given, std::size_t t);

  const SourceMesh& mesh_;
  std::vector<Vec3f> tangents_;  ///< [corner]; 0 where the triangle has no texture, or no directions in it
  std::vector<bool> mirrored_;   ///< [triangle] its texture is: then the bitangent is -cross(normal, tangent)
};

}  // namespace lozenge
