#include "formats/patches/patch_set.h"

#include <utility>

namespace lozenge {

PatchSet empty_patch_set(PatchLayout layout) {
  PatchSet set;
  set.layout = std::move(layout);
  set.grids = PatchGrids(set.layout, 0);
  const std::size_t samples = set.grids.size();
  set.positions.assign(samples, Vec3f(0, 0, 0));
  set.normals.assign(samples, Vec3f(0, 0, 0));
  set.source_triangles.assign(samples, -1);
  set.source_weights.assign(samples, Vec3f(0, 0, 0));
  return set;
}

}  // namespace lozenge
