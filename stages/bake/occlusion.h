// Ambient occlusion of one point: the share of the sky that is open, weighted by the cosine.
#pragma once

#include <cstdint>

#include "formats/surface/ray_scene.h"

namespace lozenge {

struct OcclusionPoint {
  Vec3d position;
  Vec3d face_normal;     ///< unit, or zero where the triangle has no area
  Vec3d shading_normal;  ///< unit: the middle of the sky
};

struct OcclusionRays {
  std::int32_t count = 64;
  double nearest = 0;   ///< rays start this far above the surface
  double farthest = 0;  ///< and end here
};

/// 0 (closed) to 1 (open). Directions are a (0, 2)-sequence, so that any power of two of them is stratified in every
/// way, moved at random by `seed`. Those below the face itself are left out: they are no part of the sky, and no
/// occluder either. Adds the rays that it shot to `rays`.
float openness(const RayScene& scene, const OcclusionPoint& point, const OcclusionRays& options, std::uint64_t seed,
               std::int64_t& rays);

}  // namespace lozenge
