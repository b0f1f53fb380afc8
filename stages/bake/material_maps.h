// What the source's materials look like at every texel: each takes what lies at its own place, by the correspondence.
#pragma once

#include "stages/bake/atlas_baker.h"

namespace lozenge {

/// RGB where the source is opaque, else RGBA.
BakedMap bake_base_colours(AtlasBaker& baker);

/// Occlusion in R: what rays found, times what the source's textures say. Roughness in G, metal in B.
/// \param occlusion  of the same atlas, in any resolution; null: the textures alone
BakedMap bake_occlusion_roughness_metal(AtlasBaker& baker, const BakedMap* occlusion);

/// As a share of Appearance::emissive_strength.
BakedMap bake_emission(AtlasBaker& baker);

/// What textures of extensions say, in the channels that they have there; 1 where a material has none.
BakedMap bake_extension(AtlasBaker& baker, MapKind kind);

}  // namespace lozenge
