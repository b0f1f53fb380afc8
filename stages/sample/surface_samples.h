// Points of the source surface at chosen places of its domain: what the patches and the plain remesh are made from.
#pragma once

#include <cstdint>
#include <vector>

#include "formats/base/progress.h"
#include "formats/domain/parameterization.h"
#include "formats/domain/source_locator.h"
#include "formats/patches/patch_set.h"
#include "formats/surface/source_mesh.h"
#include "stages/sample/boundary_corners.h"

namespace lozenge {

/// A mesh and its map, ready to be asked for the surface point at any place.
class SurfaceSampler {
 public:
  /// Keeps a reference to `mesh`.
  /// \throws Error(kUnusableInput) where the map is broken
  SurfaceSampler(const SourceMesh& mesh, const Parameterization& map);

  /// One sample of the surface.
  struct Sample {
    Vec3f position{0, 0, 0};  ///< never holds -0
    Vec3f normal{0, 0, 0};
    SourcePoint source;
  };
  /// \throws Error(kUnusableInput) where no source triangle's image holds the place
  Sample at(const DomainPoint& place) const;
  Sample at(const SourcePoint& source) const;

 private:
  const SourceMesh& mesh_;
  DomainLocator locator_;
  ShadingNormals normals_;
};

/// Samples the patches of a map, on as many grids as one likes: any number a side from 2, where `sample` wants 2^k + 1.
class PatchSampler {
 public:
  /// Keeps references to both.
  /// \throws Error(kUnusableInput) where the map is broken
  PatchSampler(const SourceMesh& mesh, const Parameterization& map);

  const SourceMesh& mesh() const { return mesh_; }
  /// The map's patches with so many samples a side.
  PatchLayout layout(std::int32_t samples) const { return patch_layout(mesh_, map_, samples); }

  /// Positions, normals and source points of a layout's samples, borders shared: what measuring needs.
  /// \throws Error(kUnusableInput) where a place is left uncovered, Error(kLimit) where they are too many
  PatchSet locate(PatchLayout layout, const Progress& progress) const;
  /// Those, samples of different places told apart, and with all else that they carry.
  PatchSet sample(PatchLayout layout, const Progress& progress) const;

 private:
  const SourceMesh& mesh_;
  const Parameterization& map_;
  SurfaceSampler sampler_;
  BoundaryCorners corners_;
};

}  // namespace lozenge
