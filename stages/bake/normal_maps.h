// The source's shading normals with those of its normal textures, as they are and in the tangent frames of the level of
// detail.
#pragma once

#include "stages/bake/atlas_baker.h"

namespace lozenge {

BakedMap bake_object_normals(AtlasBaker& baker);

/// The object-space normal of every texel, gutters too, in the frame of the texel's own patch.
BakedMap bake_tangent_normals(const AtlasBaker& baker, const BakedMap& object_normals);

}  // namespace lozenge
