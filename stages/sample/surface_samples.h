// Points of the source surface at chosen places of its domain: what the patches and the plain remesh are made from.
#pragma once

#include <cstdint>
#include <functional>
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

/// The patches of the map's domain with `samples` samples a side: any number from 2, where `sample` wants 2^k + 1.
PatchSet sample_patches(const SourceMesh& mesh, const Parameterization& map, std::int32_t samples,
                        const Progress& progress);

/// Runs `work(n)` for n = 0..count-1 in parallel and tells how far it is; of several errors, the one of the lowest n is
/// thrown.
void for_each_in_parallel(std::int32_t count, const char* what, const Progress& progress,
                          const std::function<void(std::int32_t)>& work);

}  // namespace lozenge
