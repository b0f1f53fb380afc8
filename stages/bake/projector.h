// From a place of the atlas to the source point that it shows: along rays, and by the correspondence.
#pragma once

#include <vector>

#include "formats/domain/parameterization.h"
#include "formats/domain/source_locator.h"
#include "formats/patches/target_surface.h"
#include "formats/surface/ray_scene.h"
#include "formats/surface/source_mesh.h"

namespace lozenge {

class Projector {
 public:
  /// Keeps references to all.
  /// \throws Error(kUnusableInput) where the map is folded
  Projector(const SourceMesh& mesh, const Parameterization& map, const GeometryImage& image);

  /// The source point whose image is the place (u, v) of the patch.
  /// \throws Error(kUnusableInput) where the map covers no such point
  SourcePoint correspondence(std::int32_t patch, double u, double v) const;

  /// The same, and how the weights change for a step of 1 along u (`along_u`) and along v there.
  LocatedPoint locate(std::int32_t patch, double u, double v) const;

  /// How far rays should go: twice the 99th percentile of the distance between a point of the target and the
  /// source point that corresponds to it, at points spread over every patch. Twice, for along a slanting normal the way
  /// is longer than the distance; and not the maximum, for one cut-off finger would let all rays reach into other
  /// parts.
  double measured_cage(const TargetSurface& target) const;

  const RayScene& scene() const { return scene_; }
  const SourceMesh& mesh() const { return mesh_; }
  /// Unit normal of the source triangle; (0, 0, 0) where it has no area.
  Vec3d face_normal(TriangleId t) const;
  /// A length that is nothing against the mesh, but more than rounding.
  double tiny() const { return tiny_; }

 private:
  [[noreturn]] void refuse_hole(DomainTriangleId triangle) const;

  const SourceMesh& mesh_;
  const GeometryImage& image_;
  RayScene scene_;
  SourceLocator images_;
  std::vector<TriangleLocator> locators_;  ///< [domain triangle]
  double tiny_;
};

}  // namespace lozenge
