// Where the vertices of levels lie on the source: what files have no room for (morph targets) is found there.
#pragma once

#include <vector>

#include "formats/patches/charted_surface.h"
#include "formats/surface/ray_scene.h"
#include "formats/surface/source_mesh.h"

namespace lozenge {

/// The place between the corners of a triangle of the source level, by that triangle of the source; none (triangle -1)
/// where nothing bends it, for only triangles that bend say whose they are (`source_level`).
SourcePoint origin_at(const SourceMesh& mesh, const ChartedSurface& source, TriangleId triangle, const Vec3d& weights);

/// [vertex of the level] the source's nearest point, or, where that is another body's, what it stood for.
/// \param scene  of the triangles of `source`, the source level \param stood_for  [vertex] a vertex of `source`
/// \param bodies  of patches
std::vector<SourcePoint> origins_of_level(const ChartedSurface& level, const SourceMesh& mesh,
                                          const ChartedSurface& source, const RayScene& scene,
                                          const std::vector<VertexId>& stood_for, const Bodies& bodies);

}  // namespace lozenge
