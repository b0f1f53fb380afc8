// Points of the source surface at chosen places of its domain: what the patches and the plain remesh are made from.
#pragma once

#include <cstdint>
#include <vector>

#include "formats/base/progress.h"
#include "formats/domain/parameterization.h"
#include "formats/domain/source_locator.h"
#include "formats/patches/patch_set.h"
#include "formats/surface/source_mesh.h"

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

/// The samples of a layout of the map's patches: any number a side from 2, where `sample` wants 2^k + 1.
PatchSet sample_patches(const SourceMesh& mesh, const Parameterization& map, PatchLayout layout,
                        const Progress& progress);

}  // namespace lozenge
