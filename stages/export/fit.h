// Fits the vertices of a level of detail to the surface that it stands for.
#pragma once

#include "formats/patches/charted_surface.h"
#include "formats/surface/ray_scene.h"
#include "stages/export/fit_samples.h"

namespace lozenge {

/// Moves the vertices of `level` so that its surface comes as near to `source` as it can: least squares of the
/// distances along the source's normals, between each place of the source and the level's point that corresponds to it,
/// and between places of the level and the source's nearest points; weighed far less, of all of the way
/// between them, which keeps vertices where the map has them. Vertices are shared between patches, so borders stay
/// closed; no triangle is turned further from the source's normals than it was. What corners carry become
/// normals (`set_corner_normals`). \param scene  of the source's triangles \pre both lie in
/// the charts of one atlas
void fit_to_source(ChartedSurface& level, const ChartedSurface& places, const ChartedSurface& source,
                   const RayScene& scene, const FitPatches& patches);

}  // namespace lozenge
