// How open the sky is over every texel.
#pragma once

#include "stages/bake/atlas_baker.h"

namespace lozenge {

/// At the resolution of BakeOptions::occlusion_size. Texels in gutters are baked like all others, for their places are
/// not those of the neighbour's texels.
BakedMap bake_occlusion(AtlasBaker& baker);

}  // namespace lozenge
