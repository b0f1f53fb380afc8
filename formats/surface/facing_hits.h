// What is seen of a mesh from points near to it: both ways along a normal, the nearer hit that faces the same way.
#pragma once

#include <functional>
#include <span>

#include "formats/surface/ray_scene.h"

namespace lozenge {

struct OrientedPoint {
  Vec3d position;
  Vec3d normal;  ///< unit
};

/// For each point, from it both ways along its normal: the nearer of the two first hits, of those on triangles that
/// face the normal's way; one that doesn't exist where neither ray meets such a triangle.
/// \param cage   rays go so far, in the mesh's units
/// \param tiny   and start so far before the point, so that a triangle in the very same place is met
/// \pre  `hits` has a place for each point. \return how many rays were shot
std::int64_t facing_hits(const RayScene& scene, std::span<const OrientedPoint> points, double cage, double tiny,
                         std::span<RayHit> hits);

/// The same, but what faces the other way, or doesn't count, is looked through: the nearest of the hits behind one
/// another.
/// \param counts  of the number of a point and a triangle
void facing_hits_through(const RayScene& scene, std::span<const OrientedPoint> points, double cage, double tiny,
                         const std::function<bool(std::size_t, TriangleId)>& counts, std::span<RayHit> hits);

}  // namespace lozenge
