// The tangent frames that the source's normal textures are in.
#pragma once

#include <vector>

#include "formats/surface/source_mesh.h"

namespace lozenge {

/// At corners: made of the texture coordinates of each triangle's own normal texture, as it lies on the surface, the
/// way that glTF asks for where vertices have no tangents (MikkTSpace, by its description): each triangle's direction
/// of growing u, laid into the tangent plane of the corner, and the mean of those of all triangles around the vertex
/// that agree in normal, texture coordinates and handedness, weighted by their angles.
class SourceTangents {
 public:
  /// Keeps references to both.
  SourceTangents(const SourceMesh& mesh, const ShadingNormals& normals);

  /// The direction that a normal texture's value, of components from -1 to 1, means at a point.
  /// \param normal  unit, the shading normal there
  Vec3d to_object(TriangleId t, const Vec3d& weights, const Vec3d& normal, const Vec3d& texel) const;

 private:
  const SourceMesh& mesh_;
  std::vector<Vec3f> tangents_;  ///< [corner]; 0 where the triangle has no normal texture, or no directions in it
  std::vector<bool> mirrored_;   ///< [triangle] its texture is: then the bitangent is -cross(normal, tangent)
};

}  // namespace lozenge
