// What the source's textures say in directions, in the tangent frames of its own triangles in the atlas: normals, and
// along what it is brushed.
#pragma once

#include "stages/bake/atlas_baker.h"

namespace lozenge {

/// Always by the correspondence: that surface is the source's.
BakedMap bake_source_normals(AtlasBaker& baker, const SourceMesh& mesh, const Parameterization& map,
                             const GeometryImage& image);

/// The directions of the clearcoat's normal textures in the same frames. Other levels of detail have other ones, but
/// nearly the same tangents.
BakedMap bake_clearcoat_normals(AtlasBaker& baker, const SourceMesh& mesh, const Parameterization& map,
                                const GeometryImage& image);

/// Along which directions the source is brushed, in the same frames, and how strongly.
BakedMap bake_anisotropy(AtlasBaker& baker, const SourceMesh& mesh, const Parameterization& map,
                         const GeometryImage& image);

}  // namespace lozenge
