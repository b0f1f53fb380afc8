// Each body of a surface by itself, where it was modelled: what is hidden at rest by another body, or by another part
// of the same skin, needn't be so in other poses.
#pragma once

#include <vector>

#include "formats/domain/source_locator.h"
#include "formats/surface/ray_scene.h"
#include "formats/surface/source_mesh.h"
#include "stages/bake/occlusion.h"

namespace lozenge {

class ModelledBodies {
 public:
  explicit ModelledBodies(const SourceMesh& mesh);

  /// The point of the surface in its body's own space. \pre it lies on a triangle
  OcclusionPoint at(const SourcePoint& point) const;
  /// The triangles of the body that this one is of.
  const RayScene& scene_of(TriangleId t) const { return scenes_[slot_of(t)]; }
  /// How long a unit of the scene is in the body's own space.
  double unit_of(TriangleId t) const { return units_[slot_of(t)]; }

 private:
  std::size_t slot_of(TriangleId t) const;

  SourceMesh mesh_;
  ShadingNormals normals_;
  std::vector<RayScene> scenes_;  ///< [body + 1]; the first is what stands still
  std::vector<double> units_;     ///< the same
};

}  // namespace lozenge
