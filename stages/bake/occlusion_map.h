// How open the sky is over every texel.
#pragma once

#include "stages/bake/atlas_baker.h"

namespace lozenge {

/// At the resolution of BakeOptions::occlusion_size.
BakedMap bake_occlusion(AtlasBaker& baker);

}  // namespace lozenge
