// The normals of a fitted level's corners: smooth where the source's shading is, apart on both sides of its creases, so
// that each side is shaded, and has its map of normals, as if the other weren't there.
#pragma once

#include <span>

#include "formats/patches/charted_surface.h"
#include "formats/surface/ray_scene.h"

namespace lozenge {

/// A place of a level, and how the source is shaded at its nearest point there.
struct ShadedPlace {
  TriangleId triangle = -1;
  Vec3f weights{0, 0, 0};
  Vec3f normal{0, 0, 0};  ///< of any length
  float area = 0;         ///< that it stands for
};

/// What corners carry becomes a unit normal: the mean of the source's around the vertex, weighed by area, over the
/// triangles that are no crease away; that of these triangles themselves where the mean cancels out, or points another
/// way. An edge is a crease where the level bends and the source's normals close to both sides of it do as well.
/// \param source  carries unit normals \param scene  of its triangles
void set_corner_normals(ChartedSurface& level, std::span<const ShadedPlace> places, const ChartedSurface& source,
                        const RayScene& scene);

}  // namespace lozenge
