// The source's normals, with those of its normal textures, in the tangent frames of its own triangles in the atlas.
#pragma once

#include "stages/bake/atlas_baker.h"

namespace lozenge {

/// Always by the correspondence: that surface is the source's.
BakedMap bake_source_normals(AtlasBaker& baker, const SourceMesh& mesh, const Parameterization& map,
                             const GeometryImage& image);

}  // namespace lozenge
