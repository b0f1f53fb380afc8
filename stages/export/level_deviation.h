// How far a level of detail is from the source, in distances and in what one sees of its normals.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "formats/patches/baked_maps.h"
#include "formats/patches/charted_surface.h"
#include "formats/patches/framed_surface.h"
#include "formats/patches/patch_layout.h"
#include "formats/surface/ray_scene.h"

namespace lozenge {

class LevelNormals;

/// Distances both ways, of which the larger counts: means by area, the largest at places and vertices of the level.
struct LevelDeviation {
  double mean = 0;     ///< asset's units
  double largest = 0;  ///< asset's units
  double extent = 0;   ///< diagonal of the box of what of the source it stands for
  /// Mean angle between the source's normals and those that one sees, radians; nothing where no map knows the source's.
  std::optional<double> normals;
};

/// Of one level.
struct LevelDeviations {
  LevelDeviation whole;
  std::vector<LevelDeviation> bodies;  ///< what stands still, then the bodies by their numbers
};

class DeviationMeter {
 public:
  /// Keeps references to all.
  /// \param scene  of the source's triangles \param normals  null where there is no map of tangent-space normals
  DeviationMeter(const ChartedSurface& source, const RayScene& scene, const PatchLayout& patches,
                 const LevelNormals* normals);
  ~DeviationMeter();
  DeviationMeter(const DeviationMeter&) = delete;
  DeviationMeter& operator=(const DeviationMeter&) = delete;

  /// Of a level that is the source's own triangles.
  LevelDeviations of_source() const;
  /// \param map  of the level's normals, or null
  LevelDeviations of(const ChartedSurface& level, const FramedSurface& framed, const BakedMap* map) const;

 private:
  /// A place of the source that is looked at.
  struct Place;

  const RayScene& scene_;
  const Bodies& bodies_;
  const LevelNormals* normals_;
  std::vector<Place> places_;
  std::vector<double> extents_;  ///< [body + 1]
  double extent_ = 0;
};

}  // namespace lozenge
