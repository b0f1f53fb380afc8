// The places that a fit holds against each other: of the source and of a level, each with its counterpart.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "formats/patches/charted_surface.h"
#include "formats/surface/ray_scene.h"
#include "stages/export/corner_normals.h"

namespace lozenge {

/// What a fit knows of the patches.
struct FitPatches {
  std::vector<std::int32_t> parts;  ///< [patch] the connected part of the surface: none is fitted to another
  /// [patch] whether places of the source are held against the level's nearest point, not that of the same place in the
  /// atlas: where the level doesn't show each place where it was (`Simplifier::slipped_patches`).
  std::vector<bool> slipped;
  std::vector<float> importance = {};  ///< [triangle of the places] weighs its distances; empty: all the same
};

/// A place of the source, and where the level has it; in floats, for there are many.
struct FitSample {
  std::array<VertexId, 3> vertices{-1, -1, -1};  ///< of the level
  Vec3f weights{0, 0, 0};                        ///< of the level's point, one for each vertex
  Vec3f normal{0, 0, 0};                         ///< of the source, unit
  Vec3f position{0, 0, 0};                       ///< of the source
  float area = 0;                                ///< that it stands for
};

/// Places spread over the source, by the level's triangles, each with the level's point that corresponds to it.
std::vector<FitSample> samples_of_source(const ChartedSurface& source, const ChartedSurface& level,
                                         const FitPatches& patches);

/// Places spread over a level, each with the source's nearest point of the same part that faces the same way.
struct SamplesOfLevel {
  std::vector<FitSample> samples;
  std::vector<ShadedPlace> shaded;  ///< how the source is shaded there
};
/// \param scene  of the source's triangles
SamplesOfLevel samples_of_level(const ChartedSurface& level, const ChartedSurface& source, const RayScene& scene,
                                const FitPatches& patches);

}  // namespace lozenge
